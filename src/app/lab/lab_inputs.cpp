#include "app/lab/lab_inputs.h"

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

Material lab_material() {
  Material material;
  material.type = MaterialType::ggx;
  material.diffuse = vec3(0.4f);
  material.specular = vec3(0.6f);
  material.roughness = 0.5f;
  return material;
}

bool scattering_uses(MaterialType type, std::string_view key) {
  // These are of every type or of the inside: a closure does not have them.
  for (std::string_view other : {"absorption", "opacity", "emission", "two_sided_emission"})
    if (key == other) return false;
  return material_uses(type, key);
}

std::vector<const Field<Material>*> scattering_rows() {
  const auto types = static_cast<int>(material_fields()[0].choices.size());
  std::vector<const Field<Material>*> rows;
  for (const auto& row : material_fields()) {
    bool used = false;
    for (int type = 0; type < types; ++type)
      used |= scattering_uses(static_cast<MaterialType>(type), row.key);
    if (used) rows.push_back(&row);
  }
  return rows;
}

} // namespace candela
