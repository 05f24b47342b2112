#pragma once
// Where a ray met the scene.

#include "core/math.h"

#include <cstdint>

namespace candela {

/// What every hit is asked for. World space. What few are asked for comes on demand: texture coordinates and
/// tangents from Geometry::uv and tangents, their footprint from uv_footprint (ray_cone.h), and the media of
/// both sides from the material.
struct SurfaceInteraction {
  vec3 position{0};
  vec3 position_error{0};         ///< absolute bound per axis
  vec3 geometric_normal{0, 0, 1}; ///< unit; to the outside of spheres, by the winding of triangles
  vec3 shading_normal{0, 0, 1};   ///< unit, on the side of geometric_normal
  std::uint32_t material = 0;     ///< index into SceneDesc::materials
  std::uint64_t emitter = 0;      ///< number among all primitives, see Geometry::emitter_count
};

/// Partial derivatives of the position by the texture coordinates, in the surface's tangent plane. World
/// space, scene units. Where the coordinates do not tell (there are none, or a pole): any two perpendicular
/// ones, of unit length.
struct SurfaceTangents {
  vec3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
  bool has_uv = false; ///< the coordinates do tell
};

} // namespace candela
