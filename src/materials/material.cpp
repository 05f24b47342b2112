#include "materials/material.h"

#include "core/model_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr auto kTypeNames = model_names<Material>();
constexpr FieldInfo kTypeField{
    "type", FieldType::choice, 0, 0, "", "How the surface scatters light", Invalidates::scene, kTypeNames};

ParameterRef opacity_of(Material& m) { return {&m.opacity, nullptr}; }
ParameterRef normal_map_of(Material& m) { return {nullptr, &m.normal_map}; }
ParameterRef bump_of(Material& m) { return {&m.bump, nullptr}; }
ParameterRef emission_of(Material& m) { return {nullptr, &m.emission}; }

const MaterialField kCommonFields[] = {
    {{{"opacity", FieldType::real, 0, 1, "",
       "Share of the light that interacts with the surface; the rest passes straight through",
       Invalidates::scene},
      [](Material& m) -> void* { return &m.opacity.value; }},
     opacity_of},
    {{{"emission", FieldType::color, 0, 1e9, "W/(m^2 sr)", "Emitted radiance", Invalidates::scene, {}, true},
      [](Material& m) -> void* { return &m.emission.value; }},
     emission_of},
    {{{"normal_map", FieldType::color, 0, 1, "",
       "Shading normals in tangent space, as a texture: red along u, green along v (OpenGL), linear",
       Invalidates::image},
      [](Material& m) -> void* { return &m.normal_map.value; }},
     normal_map_of},
    {{{"bump", FieldType::real, -1e6, 1e6, "scene units",
       "Height that bends shading normals, as a texture; its factor is the height of white",
       Invalidates::image},
      [](Material& m) -> void* { return &m.bump.value; }},
     bump_of},
    {{{"two_sided_emission", FieldType::boolean, 0, 0, "", "Emit from both sides, not only the normal's",
       Invalidates::scene},
      [](Material& m) -> void* { return &m.two_sided_emission; }}},
};

/// The parameter of a row; empty where it is a plain value.
template <std::size_t Type, std::size_t Row>
ParameterRef parameter_at(Material& material) {
  return with_member<Type, Row>(material, [](auto& member) -> ParameterRef {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, NumberParameter>)
      return {&member, nullptr};
    else if constexpr (std::is_same_v<Member, ColorParameter>)
      return {nullptr, &member};
    else
      return {};
  });
}

template <std::size_t Type, std::size_t Row>
MaterialField material_field() {
  static constexpr auto kRows = ModelOf<Material, Type>::rows();
  const bool is_parameter = kRows[Row].member.index() < 2; // NumberParameter, ColorParameter
  return {model_field<Material, Type, Row>(), is_parameter ? parameter_at<Type, Row> : nullptr,
          kRows[Row].kept};
}

/// "emission.offset: …" of a texture's use.
std::string texture_use_problem(const MaterialField& row, const ParameterRef& parameter,
                                std::size_t texture_count) {
  TextureUse& use = parameter.use();
  if (use.texture < -1 || use.texture >= static_cast<int>(texture_count))
    return fmt::format("{}.texture: there is no texture {}", row.key, use.texture);
  for (const auto& part : texture_use_fields())
    if (auto problem = field_problem(part, part.address(use)); !problem.empty())
      return fmt::format("{}.{}: {}; give {}", row.key, part.key, problem, field_domain(part));
  if (!is_finite(vec3(use.uv.scale, 0)))
    return fmt::format("{}.uv_scale: not finite; give finite numbers", row.key);
  if (!is_finite(vec3(use.uv.offset, 0)))
    return fmt::format("{}.uv_offset: not finite; give finite numbers", row.key);
  const vec3 offset = parameter.number != nullptr ? vec3(parameter.number->offset) : parameter.color->offset;
  if (!is_finite(offset)) return fmt::format("{}.offset: not finite; give finite numbers", row.key);
  return {};
}

} // namespace

const FieldInfo& material_type_field() { return kTypeField; }
std::span<const std::string_view> material_type_names() { return kTypeNames; }
std::span<const std::string_view> scattering_type_names() {
  return std::span(kTypeNames).first<std::variant_size_v<ScatteringModel>>();
}

Material default_material(int type) { return with_model<Material>(type); }

void change_type(Material& material, int type) {
  const std::string group = material.group, medium = material.medium;
  auto copy = [](const MaterialField& to, Material& changed, const MaterialField& from, Material& old) {
    if (!from.kept || !to.kept) return;
    if (to.parameter != nullptr && from.parameter != nullptr &&
        to.parameter(changed).copy_from(from.parameter(old)))
      return;
    if (to.type == from.type) field_copy(to, to.address(changed), from.address(old));
  };
  change_model(
      material, type, [](int t) { return material_fields(t); }, copy);
  material.group = group, material.medium = medium;
}

std::span<const MaterialField> material_fields(int type) {
  static const auto tables = model_tables<Material, MaterialField>(
      []<std::size_t Type, std::size_t Row>() { return material_field<Type, Row>(); },
      [](auto) { return std::span(kCommonFields); });
  return tables[static_cast<std::size_t>(type)];
}
std::span<const MaterialField> common_material_fields() { return kCommonFields; }

const MaterialField* find_material_field(int type, std::string_view key) {
  const auto rows = material_fields(type);
  const auto found = std::ranges::find(rows, key, &FieldInfo::key);
  return found == rows.end() ? nullptr : &*found;
}

ParameterRef find_parameter(Material& material, std::string_view key) {
  const MaterialField* row = find_material_field(material_type(material), key);
  return row == nullptr || row->parameter == nullptr ? ParameterRef() : row->parameter(material);
}

bool is_textured(const Material& material) {
  bool any = false;
  each_parameter(material, [&](const MaterialField&, const ParameterRef& p) { any |= p.use().texture >= 0; });
  return any;
}

std::optional<Interior> interior(const MaterialModel& model) {
  return std::visit(
      [](const auto& m) -> std::optional<Interior> {
        if constexpr (requires { m.absorption; }) {
          Interior inside{m.absorption};
          if constexpr (requires { m.ior; }) inside.ior = m.ior.value;
          if constexpr (requires { m.priority; }) inside.priority = m.priority;
          return inside;
        } else if constexpr (requires { m.matter(); }) {
          std::optional<Interior> inside;
          if (const std::optional<HomogeneousMedium> matter = m.matter()) {
            inside.emplace();
            inside->matter = matter;
          }
          return inside;
        } else {
          return std::nullopt;
        }
      },
      model);
}

std::string material_problem(const Material& material, std::size_t texture_count) {
  auto& m = const_cast<Material&>(material);
  for (const MaterialField& row : material_fields(material)) {
    if (auto problem = field_problem(row, row.address(m)); !problem.empty())
      return fmt::format("{}: {}; give {}", row.key, problem, field_domain(row));
    if (row.parameter == nullptr) continue;
    if (auto problem = texture_use_problem(row, row.parameter(m), texture_count); !problem.empty())
      return problem;
  }
  return {};
}

} // namespace candela
