#pragma once
// Materials as shading needs them: constants evaluated once, textures at a hit.

#include "core/spectrum.h"
#include "materials/blend_parts.h"
#include "materials/material.h"
#include "media/medium_stack.h"
#include "textures/texture.h"

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace candela {

/// A parameter that is a texture, within the range of its row.
struct TexturedParameter {
  const Texture* texture = nullptr;
  TextureUse use;
  vec3 factor{1}, offset{0};
  float lowest = 0, highest = 1;
  const MipPyramid* pyramid = nullptr; ///< of a picture that is filtered

  /// Whether it is looked up over a footprint, where there is one.
  bool is_filtered() const { return use.filter == TextureFilter::trilinear; }
  bool asks_place() const { return candela::asks_place(*texture, use); }
  vec3 color(const TexturePoint& at) const {
    vec3 texel;
    if (const auto mean = mean_over(at))
      texel = texel_color(*mean, use.channel);
    else
      texel = texture_color(*texture, use, at);
    return glm::clamp(factor * texel + offset, lowest, highest);
  }
  float number(const TexturePoint& at) const {
    const auto mean = mean_over(at);
    const float texel = mean ? texel_number(*mean, use.channel) : texture_number(*texture, use, at);
    return std::clamp(factor.x * texel + offset.x, lowest, highest);
  }

private:
  std::optional<vec4> mean_over(const TexturePoint& at) const {
    if (!is_filtered() || at.is_point()) return std::nullopt;
    return texture_filtered(*texture, use, at, pyramid);
  }
};

/// A model some of whose parameters are textures: their uses name entries of `lookups`. Or a blend.
struct TexturedModel {
  MaterialModel model;
  std::vector<TexturedParameter> lookups;
  bool is_filtered = false; ///< any of them, or of the parts: it asks for the footprint
  bool asks_place = false;  ///< likewise, for the place

  // Of a blend:
  std::size_t mixed = 0;                                       ///< how many closures at most; 0: no blend
  std::array<const TexturedModel*, 2> parts{nullptr, nullptr}; ///< first and second; null: black
};

struct SurfaceMaterial {
  Bsdf bsdf;                               ///< where `textured` is null
  const TexturedModel* textured = nullptr; ///< evaluate_bsdf() knows the BSDF then
  SurfaceMaterial* back = nullptr;         ///< of the other side of the surface, where that differs: facing()
  bool varies = false;      ///< whether the BSDF depends on the hit: textured, oriented, by what lies outside
  bool is_textured = false; ///< whether hits look at textures for the BSDF or the shading normal
  bool asks_place = false;  ///< whether a texture of it looks at TexturePoint::place
  bool oriented = false;    ///< whether orient_bsdf() has something to do
  bool diffuses = false;    ///< its BSDF is a Subsurface that has a diffusion profile
  const TexturedParameter* emission_texture = nullptr;                        ///< emission_at() knows it then
  const TexturedParameter* opacity_texture = nullptr;                         ///< opacity_at(), likewise
  const TexturedParameter *normal_texture = nullptr, *bump_texture = nullptr; ///< for relief_normal()
  Spectrum emission{0};                                                       ///< W/(m^2 sr)
  float opacity = 1;
  bool invisible = false; ///< its surfaces are not there; their opacity is 0
  bool emissive = false;
  bool two_sided_emission = false;
  bool has_relief() const { return normal_texture != nullptr || bump_texture != nullptr; }
  /// By RenderScene::medium(). Bodies that absorb the same have the same medium; where anything absorbs or
  /// has a priority, a clear dielectric has one, too, for it may lie inside of that.
  MediumInterface media;
};

/// The closure of a material's constants; textured parameters are taken for their factors.
Bsdf make_bsdf(const Material& material);

/// The BSDF of a material whose `textured` is not null; its parts, if it is a blend, are in the arena.
Bsdf evaluate_bsdf(const SurfaceMaterial& material, const TexturePoint& at, BlendArena& arena);

/// The material as one side shows it, that of the geometric normal or the other one. Emission, opacity and
/// media are those of both.
inline const SurfaceMaterial& facing(const SurfaceMaterial& material, bool outside) {
  return material.back == nullptr || outside ? material : *material.back;
}

// `uv()`, a vec2 or a TexturePoint, is asked only where something is textured.

template <class Uv>
vec3 emission_at(const SurfaceMaterial& material, Uv uv) {
  return material.emission_texture == nullptr ? material.emission : material.emission_texture->color(uv());
}
template <class Uv>
float opacity_at(const SurfaceMaterial& material, Uv uv) {
  return material.opacity_texture == nullptr ? material.opacity : material.opacity_texture->number(uv());
}

/// Whether the radiance that it sends out differs over it.
inline bool has_textured_radiance(const SurfaceMaterial& material) {
  return material.emissive && (material.emission_texture != nullptr || material.opacity_texture != nullptr);
}

/// The pyramid of a picture, which somebody else owns.
using MipPyramidSource = std::function<const MipPyramid*(const ImageTexture&, ColorSpace)>;

/// The materials of a scene, and the textures that they look at.
class SurfaceMaterials {
public:
  /// Pictures that are filtered have the pyramids of that source. `all` are the materials that this one may
  /// name; they have no parts_problem().
  void add(const Material& material, const std::vector<std::shared_ptr<const Texture>>& textures,
           const MipPyramidSource& pyramids = {}, std::span<const Material> all = {});
  /// The body that surfaces of the i-th bound.
  void set_medium_inside(std::size_t i, MediumId medium);
  /// Whether any of them looks up footprints.
  bool filters_textures() const { return filters_textures_; }

  const SurfaceMaterial& operator[](std::size_t i) const { return materials_[i]; }
  auto begin() const { return materials_.begin(); }
  auto end() const { return materials_.end(); }
  std::size_t memory_bytes() const;

private:
  /// What materials are made of.
  struct Sources {
    const std::vector<std::shared_ptr<const Texture>>& textures;
    const MipPyramidSource& pyramids;
    std::span<const Material> all;
  };
  /// What is known of the models in a blend.
  struct BlendTraits {
    bool textured = false, oriented = false, has_priority = false;
  };
  SurfaceMaterial made(const Material& material, bool outside, const Sources& from);
  void set_scattering(SurfaceMaterial& out, const Material& material, bool outside, const Sources& from);
  void set_blend(SurfaceMaterial& out, const Material& blend, bool outside, const Sources& from);
  void set_common(SurfaceMaterial& out, const Material& material, const Sources& from);
  void set_relief(SurfaceMaterial& out, const Material& material, const Sources& from);
  TexturedModel textured_model(const Material& material, const Sources& from);
  const TexturedModel* blend_part(int index, bool outside, const Sources& from, BlendTraits& traits);
  const TexturedModel* blend_model(const Material& blend, bool outside, const Sources& from,
                                   BlendTraits& traits);
  TexturedParameter textured_parameter(const MaterialField& row, const ParameterRef& parameter,
                                       const Sources& from);
  const TexturedParameter* keep(const TexturedParameter& parameter) {
    return &parameters_.emplace_back(parameter);
  }

  bool filters_textures_ = false;
  std::vector<SurfaceMaterial> materials_;
  std::deque<SurfaceMaterial> backs_;        ///< what materials_ point to
  std::deque<TexturedModel> models_;         ///< likewise
  BlendArena constant_parts_;                ///< likewise, of blends that are the same everywhere
  std::deque<TexturedParameter> parameters_; ///< likewise
};

} // namespace candela
