#include "lights/light_desc.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace candela {

namespace {

template <class Model, std::size_t kRow>
void* model_address(LightDesc& light) {
  static constexpr auto kRows = Model::rows();
  Model& model = std::get<Model>(light.model);
  return std::visit([&](auto member) -> void* { return &(model.*member); }, kRows[kRow].member);
}

constexpr FieldInfo kColor{
    "color",
    FieldType::color,
    0,
    1e9,
    "",
    "point, spot: W/sr; directional: W/m^2 on a surface that faces it; constant: W/(m^2 sr); environment: "
    "a factor",
    Invalidates::scene,
    {},
    true};
constexpr FieldInfo kScale{
    "scale", FieldType::real, 0, 1e9, "", "Multiplies the colour", Invalidates::scene, {}, true};

template <class Model>
std::vector<Field<LightDesc>> fields_of() {
  static constexpr auto kRows = Model::rows();
  std::vector<Field<LightDesc>> fields;
  [&]<std::size_t... kRow>(std::index_sequence<kRow...>) {
    (fields.push_back({kRows[kRow], model_address<Model, kRow>}), ...);
  }
  (std::make_index_sequence<kRows.size()>());
  fields.push_back({kColor, [](LightDesc& light) -> void* { return &light.color; }});
  fields.push_back({kScale, [](LightDesc& light) -> void* { return &light.scale; }});
  return fields;
}

/// What is said once for each model, by its index.
struct LightTypes {
  std::vector<std::string_view> names;
  std::vector<std::vector<Field<LightDesc>>> fields;
  std::vector<LightDescModel> defaults;

  static const LightTypes& get() {
    static const LightTypes types = []<class... Models>(const std::variant<Models...>*) {
      return LightTypes{{Models::kName...}, {fields_of<Models>()...}, {LightDescModel(Models{})...}};
    }(static_cast<const LightDescModel*>(nullptr));
    return types;
  }
};

} // namespace

std::span<const std::string_view> light_type_names() { return LightTypes::get().names; }

const FieldInfo& light_type_field() {
  static const FieldInfo field{
      "type",
      FieldType::choice,
      0,
      0,
      "",
      "point, directional (a distant one), constant (all around), spot or environment (a panorama)",
      Invalidates::scene,
      light_type_names()};
  return field;
}

LightDesc default_light(int type) {
  LightDesc light;
  light.model = LightTypes::get().defaults[static_cast<std::size_t>(type)];
  return light;
}

std::span<const Field<LightDesc>> light_fields(int type) {
  return LightTypes::get().fields[static_cast<std::size_t>(type)];
}

void change_type(LightDesc& light, int type) {
  if (light_type(light) == type) return;
  LightDesc changed = default_light(type);
  changed.name = light.name;
  for (const auto& row : light_fields(type))
    for (const auto& old : light_fields(light))
      if (old.key == row.key && old.type == row.type)
        field_copy(row, row.address(changed), old.address(light));
  light = std::move(changed);
}

Light make_light(const LightDesc& light, const EnvironmentMapSource& maps) {
  const Spectrum color = light.color * light.scale;
  return std::visit(
      [&](const auto& model) {
        const auto made = light_of(model, color, maps);
        if constexpr (requires { made.index(); }) // one of several
          return std::visit([](const auto& one) { return Light(one); }, made);
        else
          return Light(made);
      },
      light.model);
}

const vec3* light_position(const LightDesc& light) {
  return std::visit(
      [](const auto& model) -> const vec3* {
        if constexpr (requires { model.position; })
          return &model.position;
        else
          return nullptr;
      },
      light.model);
}

vec3* light_position(LightDesc& light) {
  return const_cast<vec3*>(light_position(static_cast<const LightDesc&>(light)));
}

std::shared_ptr<const Panorama> light_panorama(const LightDesc& light) {
  const auto* environment = std::get_if<EnvironmentLightModel>(&light.model);
  return environment != nullptr ? environment->panorama : nullptr;
}

std::string light_problem(const LightDesc& light) {
  for (const auto& row : light_fields(light))
    if (auto problem = field_problem(row, row.address(const_cast<LightDesc&>(light))); !problem.empty())
      return fmt::format("{}: {}; give {}", row.key, problem, field_domain(row));
  return std::visit([](const auto& model) { return model.problem(); }, light.model);
}

std::string EnvironmentLightModel::problem() const {
  if (is_zero(up)) return "up: has no length; give a direction";
  if (!panorama) return "";
  const Image& image = panorama->image;
  if (image.width <= 0 || image.height <= 0 ||
      image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    return "panorama: its pixels do not fit its size; give width times height";
  for (vec3 pixel : image.pixels)
    if (!(is_finite(pixel) && min_component(pixel) >= 0))
      return "panorama: a pixel is negative or not finite; give radiances";
  return "";
}

} // namespace candela
