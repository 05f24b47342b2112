#pragma once
// Textures on surfaces without coordinates: projected along the axes of the object, and blended by the
// normal.

#include "textures/texture_point.h"
#include "textures/texture_use.h"

#include <array>

namespace candela {

/// One of the three projections.
struct ProjectedPoint {
  float weight = 0;         ///< of the three together 1
  vec3 across{0}, up{0};    ///< the object's directions along which u and v of the plane grow; unit
  TexturePoint at{vec2(0)}; ///< before the transform of the use
};

/// The projections of a place. Pictures stand upright where +y is up, and are not mirrored on either side; on
/// what faces up or down +z is towards their lower or upper border. A projection counts as its axis' share of
/// the normal exceeds 1 - blend of the greatest.
inline std::array<ProjectedPoint, 3> project_triplanar(const SurfacePlace& place,
                                                       const UvFootprint& footprint, float blend) {
  constexpr float kSharpest = 1e-4f;
  const vec3 share = glm::abs(place.normal) / std::max(max_component(glm::abs(place.normal)), 1e-20f);
  vec3 weight = glm::max(share - (1 - std::max(blend, kSharpest)), 0.0f);
  weight /= weight.x + weight.y + weight.z;
  const vec3 side(std::copysign(1.0f, place.normal.x), std::copysign(1.0f, place.normal.y),
                  std::copysign(1.0f, place.normal.z));
  std::array<ProjectedPoint, 3> out;
  out[0].across = {0, 0, -side.x}, out[0].up = {0, 1, 0};
  out[1].across = {1, 0, 0}, out[1].up = {0, 0, -side.y};
  out[2].across = {side.z, 0, 0}, out[2].up = {0, 1, 0};
  for (int k = 0; k < 3; ++k) {
    ProjectedPoint& p = out[static_cast<std::size_t>(k)];
    p.weight = weight[k];
    auto project = [&](vec3 v) { return vec2(glm::dot(v, p.across), glm::dot(v, p.up)); };
    auto axis = [&](vec2 step) { return project(step.x * place.dpdu + step.y * place.dpdv); };
    p.at = {project(place.position), {axis(footprint.major), axis(footprint.minor)}};
  }
  return out;
}

} // namespace candela
