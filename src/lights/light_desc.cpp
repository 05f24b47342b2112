#include "lights/light_desc.h"

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

/// The rows that follow those of the model: the colour, in the model's unit, and the scale.
template <std::size_t Type>
std::array<Field<LightDesc>, 2> common_fields() {
  constexpr FieldInfo kScale{
      "scale", FieldType::real, 0, 1e9, "", "Multiplies the colour", Invalidates::scene, {}, true};
  return {{{ModelOf<LightDesc, Type>::kColor, [](LightDesc& light) -> void* { return &light.color; }},
           {kScale, [](LightDesc& light) -> void* { return &light.scale; }}}};
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
  auto copy = [](const auto& to, LightDesc& changed, const auto& from, LightDesc& old) {
    if (to.type == from.type) field_copy(to, to.address(changed), from.address(old));
  };
  change_model(
      light, type, [](int t) { return light_fields(t); }, copy);
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

} // namespace candela
