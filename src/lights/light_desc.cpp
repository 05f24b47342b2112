#include "lights/light_desc.h"

#include "core/blackbody.h"
#include "core/model_fields.h"

#include <fmt/format.h>

namespace candela {

namespace {

constexpr auto kTypeNames = model_names<LightDesc>();

/// "point: …; spot: …", as the models describe themselves.
std::string type_help() {
  std::string out;
  [&]<std::size_t... Type>(std::index_sequence<Type...>) {
    ((out +=
      fmt::format("{}{}: {}", Type > 0 ? "; " : "", kTypeNames[Type], ModelOf<LightDesc, Type>::kHelp)),
     ...);
  }
  (ModelTypes<LightDesc>());
  return out;
}

/// The rows that follow those of the model: the colour, in the model's unit, the scale and the temperature.
template <std::size_t Type>
std::array<Field<LightDesc>, 3> common_fields() {
  constexpr FieldInfo kScale{
      "scale", FieldType::real, 0, 1e9, "", "Multiplies the colour", Invalidates::scene, {}, true};
  constexpr FieldInfo kTemperature{
      "temperature",
      FieldType::real,
      0,
      kHottestKelvin,
      "K",
      "Multiplies the colour by that of a black body whose luminance is 1, from 800 K on; 0: by nothing",
      Invalidates::scene};
  return {{{ModelOf<LightDesc, Type>::kColor, [](LightDesc& light) -> void* { return &light.color; }},
           {kScale, [](LightDesc& light) -> void* { return &light.scale; }},
           {kTemperature, [](LightDesc& light) -> void* { return &light.temperature; }}}};
}

} // namespace

std::span<const std::string_view> light_type_names() { return kTypeNames; }

const FieldInfo& light_type_field() {
  static const std::string help = type_help();
  static const FieldInfo field{"type", FieldType::choice, 0, 0, "", help, Invalidates::scene, kTypeNames};
  return field;
}

LightDesc default_light(int type) { return with_model<LightDesc>(type); }

std::span<const Field<LightDesc>> light_fields(int type) {
  static const auto tables = model_tables<LightDesc, Field<LightDesc>>(
      []<std::size_t Type, std::size_t Row>() { return model_field<LightDesc, Type, Row>(); },
      [](auto light_type) { return common_fields<decltype(light_type)::value>(); });
  return tables[static_cast<std::size_t>(type)];
}

void change_type(LightDesc& light, int type) {
  const auto profile = light_profile(light);
  const std::string group = light.group;
  auto copy = [](const auto& to, LightDesc& changed, const auto& from, LightDesc& old) {
    if (to.type == from.type) field_copy(to, to.address(changed), from.address(old));
  };
  change_model(
      light, type, [](int t) { return light_fields(t); }, copy);
  light.group = group;
  if (profile && takes_profile(light)) set_profile(light, profile);
}

Spectrum light_color(const LightDesc& light) {
  const Spectrum color = light.color * light.scale;
  return light.temperature > 0 ? color * blackbody_color(light.temperature) : color;
}

namespace {

/// Of light_of(): a light, one of several kinds, or several of such.
template <class Made>
void add_made(std::vector<Light>& lights, const Made& made) {
  if constexpr (requires { made.begin(); }) {
    for (const auto& one : made) add_made(lights, one);
  } else if constexpr (requires { made.index(); }) {
    std::visit([&](const auto& one) { add_made(lights, one); }, made);
  } else {
    lights.emplace_back(made);
  }
}

} // namespace

std::vector<Light> make_lights(const LightDesc& light, const LightResources& resources) {
  const Spectrum color = light_color(light);
  std::vector<Light> lights;
  std::visit([&](const auto& model) { add_made(lights, light_of(model, color, resources)); }, light.model);
  return lights;
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

namespace {

/// The member by which models refer to a file, if a light's model has it.
template <class Light>
auto* panorama_member(Light& light) {
  using Pointer = decltype(&std::get<EnvironmentLightModel>(light.model).panorama);
  return std::visit(
      [](auto& model) -> Pointer {
        if constexpr (requires { model.panorama; })
          return &model.panorama;
        else
          return nullptr;
      },
      light.model);
}
template <class Light>
auto* profile_member(Light& light) {
  using Pointer = decltype(&std::get<PointLightModel>(light.model).profile);
  return std::visit(
      [](auto& model) -> Pointer {
        if constexpr (requires { model.profile; })
          return &model.profile;
        else
          return nullptr;
      },
      light.model);
}

} // namespace

std::shared_ptr<const Panorama> light_panorama(const LightDesc& light) {
  const auto* member = panorama_member(light);
  return member != nullptr ? *member : nullptr;
}
bool takes_panorama(const LightDesc& light) { return panorama_member(light) != nullptr; }
void set_panorama(LightDesc& light, std::shared_ptr<const Panorama> panorama) {
  *panorama_member(light) = std::move(panorama);
}

std::shared_ptr<const IesProfile> light_profile(const LightDesc& light) {
  const auto* member = profile_member(light);
  return member != nullptr ? *member : nullptr;
}
bool takes_profile(const LightDesc& light) { return profile_member(light) != nullptr; }
void set_profile(LightDesc& light, std::shared_ptr<const IesProfile> profile) {
  *profile_member(light) = std::move(profile);
}

std::string light_problem(const LightDesc& light) {
  for (const auto& row : light_fields(light))
    if (auto problem = field_problem(row, row.address(const_cast<LightDesc&>(light))); !problem.empty())
      return fmt::format("{}: {}; give {}", row.key, problem, field_domain(row));
  if (const auto profile = light_profile(light)) {
    if (light_panorama(light)) return "profile: there is a picture, too; give one of them";
    if (const std::string problem = ies_profile_problem(*profile); !problem.empty())
      return fmt::format("profile: {}; give the values of LM-63", problem);
  }
  return std::visit([](const auto& model) { return model.problem(); }, light.model);
}

} // namespace candela
