#pragma once
// Emission that a texture gives, where light sampling finds it.

#include "render/world/geometry.h"
#include "render/world/surface_material.h"

namespace candela {

/// Texture coordinates of a point (world space) on the primitive of that number among the emitters
/// (Geometry::emitter_count). They are those of a ray that meets the point, but for rounding.
vec2 emitter_uv(const Geometry& geometry, std::uint64_t emitter, vec3 point);

/// An emitter whose radiance depends on the point.
struct EmitterTexture {
  std::uint64_t emitter = 0;
  const SurfaceMaterial* material = nullptr;

  /// What light sampling must expect of the point: a ray meets the surface there with the probability of its
  /// opacity. W/(m^2 sr).
  vec3 radiance(const Geometry& geometry, vec3 point) const {
    const vec2 uv = emitter_uv(geometry, emitter, point);
    auto there = [uv] { return uv; };
    return emission_at(*material, there) * opacity_at(*material, there);
  }
};

} // namespace candela
