#include "app/lab/lab_inputs.h"

#include "render/world/surface_material.h"

namespace candela {

std::vector<const Field<Document>*> sampler_rows() {
  std::vector<const Field<Document>*> rows;
  for (const auto& row : settings_table())
    if (row.key.starts_with("sampler.")) rows.push_back(&row);
  return rows;
}

SampleSource sample_source(const SamplerSettings& settings) {
  return {settings.type, static_cast<std::uint64_t>(settings.seed), settings.strata};
}

MaterialChoice lab_material() {
  MaterialChoice material;
  constexpr std::pair<std::string_view, std::string_view> kValues[] = {
      {"type", "ggx"}, {"diffuse", "0.4"}, {"specular", "0.6"}, {"roughness", "0.5"}};
  for (auto [key, text] : kValues)
    for (const auto& row : scattering_rows())
      if (row.key == key) field_from_text(row, row.address(material), text);
  return material;
}

std::span<const Field<MaterialChoice>> scattering_rows() {
  static const std::vector<Field<MaterialChoice>> rows = [] {
    FieldInfo type = material_type_field();
    type.choices = scattering_type_names(); // the others depend on a scene
    std::vector<Field<MaterialChoice>> out = {{type, [](MaterialChoice& m) -> void* { return &m.type; }}};
    for (const auto& row : material_choice_fields())
      if (is_parameter_key(row.key)) out.push_back(row);
    return out;
  }();
  return rows;
}

bool scattering_uses(int type, std::string_view key) {
  return key == material_type_field().key ||
         (is_parameter_key(key) && find_material_field(type, key) != nullptr);
}

Bsdf lab_bsdf(const MaterialChoice& material) { return make_bsdf(chosen_material(material, true)); }

} // namespace candela
