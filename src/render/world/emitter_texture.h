#pragma once
// Emission that a texture gives, where light sampling finds it.

#include "render/world/surface_material.h"

namespace candela {

class RenderScene;

/// Where a point (world space) on the primitive of that number among the emitters (Geometry::emitter_count)
/// is looked up. It is where a ray that meets the point does, but for rounding.
TexturePoint emitter_point(const RenderScene& scene, std::uint64_t emitter, vec3 point, bool asks_place);

/// An emitter whose radiance depends on the point.
struct EmitterTexture {
  std::uint64_t emitter = 0;
  const SurfaceMaterial* material = nullptr;

  /// What light sampling must expect of the point: a ray meets the surface there with the probability of its
  /// opacity. W/(m^2 sr).
  vec3 radiance(const RenderScene& scene, vec3 point) const {
    const TexturePoint at = emitter_point(scene, emitter, point, material->asks_place);
    auto there = [&at]() -> const TexturePoint& { return at; };
    return emission_at(*material, there) * opacity_at(*material, there);
  }
};

} // namespace candela
