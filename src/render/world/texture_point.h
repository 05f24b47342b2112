#pragma once
// Where a hit is in texture coordinates, and how much of them it stands for.

#include "render/world/ray_cone.h"
#include "render/world/surface_place.h"

namespace candela {

/// Of a hit of a ray of unit direction. A point where `cone` is null, and on surfaces without coordinates
/// unless the place is asked for, as SurfaceMaterial::asks_place has it.
inline TexturePoint texture_point(const RenderScene& scene, const Ray& ray, const Hit& hit,
                                  const ConeOfRay* cone, bool asks_place) {
  const Geometry& geometry = scene.geometry();
  TexturePoint at = geometry.uv(ray, hit);
  if (cone == nullptr && !asks_place) return at;
  SurfaceTangents tangents = geometry.tangents(ray, hit);
  if (asks_place) at.place = surface_place(scene, ray, hit, tangents);
  if (cone == nullptr) return at;
  tangents.has_uv |= asks_place; // a footprint by tangents of unit length, which the place has, too
  const vec3 normal = glm::normalize(glm::cross(tangents.dpdu, tangents.dpdv));
  at.footprint = uv_footprint(ray.direction, normal, cone->width_at(ray.at(hit.t)), tangents);
  return at;
}

} // namespace candela
