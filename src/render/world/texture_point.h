#pragma once
// Where a hit is in texture coordinates, and how much of them it stands for.

#include "render/world/geometry.h"
#include "render/world/ray_cone.h"

namespace candela {

/// Of a hit of a ray of unit direction. A point where `cone` is null.
inline TexturePoint texture_point(const Geometry& geometry, const Ray& ray, const Hit& hit,
                                  const ConeOfRay* cone) {
  const vec2 uv = geometry.uv(ray, hit);
  if (cone == nullptr) return uv;
  const SurfaceTangents tangents = geometry.tangents(ray, hit);
  const vec3 normal = glm::normalize(glm::cross(tangents.dpdu, tangents.dpdv));
  return {uv, uv_footprint(ray.direction, normal, cone->width_at(ray.at(hit.t)), tangents)};
}

} // namespace candela
