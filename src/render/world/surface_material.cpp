#include "render/world/surface_material.h"

namespace candela {

namespace {

TexturedParameter textured_parameter(const MaterialField& row, const ParameterRef& parameter,
                                     const std::vector<std::shared_ptr<const Texture>>& textures,
                                     const MipPyramidSource& pyramids) {
  TexturedParameter out;
  out.use = parameter.use();
  out.texture = textures[static_cast<std::size_t>(out.use.texture)].get();
  out.factor = parameter.number != nullptr ? vec3(parameter.number->value) : parameter.color->value;
  out.offset = parameter.number != nullptr ? vec3(parameter.number->offset) : parameter.color->offset;
  out.lowest = static_cast<float>(row.minimum);
  out.highest = static_cast<float>(row.maximum);
  const ImageTexture* image = out.texture->image();
  if (out.is_filtered() && image != nullptr && pyramids) out.pyramid = pyramids(*image, out.use.color_space);
  return out;
}

} // namespace

Bsdf make_bsdf(const Material& material) {
  return with_closure(
      material.model, [](const auto& parameter) { return parameter.value; },
      [](const auto& closure) { return Bsdf(closure); });
}

Bsdf evaluate_bsdf(const SurfaceMaterial& material, const TexturePoint& point) {
  const TexturedModel& textured = *material.textured;
  auto at = [&]<class T>(const Parameter<T>& parameter) -> T {
    if (!parameter.is_textured()) return parameter.value;
    const TexturedParameter& lookup = textured.lookups[static_cast<std::size_t>(parameter.use.texture)];
    if constexpr (std::is_same_v<T, float>)
      return lookup.number(point);
    else
      return lookup.color(point);
  };
  return with_closure(textured.model, at, [](const auto& closure) { return Bsdf(closure); });
}

void SurfaceMaterials::add(const Material& material,
                           const std::vector<std::shared_ptr<const Texture>>& textures,
                           const MipPyramidSource& pyramids) {
  SurfaceMaterial& out = materials_.emplace_back();
  out.bsdf = make_bsdf(material);
  Material numbered = material; // whose uses name lookups rather than textures
  std::vector<TexturedParameter> lookups;
  each_parameter(numbered, [&](const MaterialField& row, const ParameterRef& parameter) {
    if (parameter.use().texture < 0) return;
    const TexturedParameter textured = textured_parameter(row, parameter, textures, pyramids);
    filters_textures_ |= textured.is_filtered();
    if (parameter.number == &numbered.opacity) {
      out.opacity_texture = keep(textured);
    } else if (parameter.color == &numbered.emission) {
      out.emission_texture = keep(textured);
    } else if (parameter.color == &numbered.normal_map) {
      out.normal_texture = keep(textured);
    } else if (parameter.number == &numbered.bump) {
      out.bump_texture = keep(textured);
    } else {
      parameter.use().texture = static_cast<int>(lookups.size());
      lookups.push_back(textured);
    }
  });
  if (!lookups.empty()) {
    const bool filtered = std::ranges::any_of(lookups, &TexturedParameter::is_filtered);
    models_.push_back({numbered.model, std::move(lookups), filtered});
    out.textured = &models_.back();
    out.varies = true;
  }
  // Of one with textures nobody knows before the hit.
  out.oriented = out.textured != nullptr ? has_tangent(out.bsdf) : is_anisotropic(out.bsdf);
  out.varies |= out.oriented;
  out.is_textured = out.textured != nullptr || out.has_relief();
  out.opacity = material.opacity.value;
  out.emission = material.emission.value;
  out.emissive = !is_black(material.emission.value) ||
                 (out.emission_texture != nullptr && max_component(material.emission.offset) > 0);
  out.two_sided_emission = material.two_sided_emission;
}

std::size_t SurfaceMaterials::memory_bytes() const {
  return materials_.size() * sizeof(SurfaceMaterial) + models_.size() * sizeof(TexturedModel) +
         parameters_.size() * sizeof(TexturedParameter);
}

} // namespace candela
