#pragma once
// What the tangents of a surface are for: normals that textures give, and closures that tell directions in
// the surface apart.

#include "render/world/ray_cone.h"
#include "render/world/render_scene.h"

namespace candela {

/// The shading normal of a hit, by the material's normal map and bump map, of which there is one. On the side
/// of the geometric normal. Textures are filtered over the cone, unless it is null.
vec3 relief_normal(const SurfaceMaterial& material, const RenderScene& scene, const Ray& ray, const Hit& hit,
                   const SurfaceInteraction& surface, const ConeOfRay* cone = nullptr);

/// The shading normal of a hit: relief_normal() where the material has a relief, else the surface's own.
inline vec3 shading_normal_at(const SurfaceMaterial& material, const RenderScene& scene, const Ray& ray,
                              const Hit& hit, const SurfaceInteraction& surface,
                              const ConeOfRay* cone = nullptr) {
  return material.has_relief() ? relief_normal(material, scene, ray, hit, surface, cone)
                               : surface.shading_normal;
}

/// Tells an anisotropic closure where dp/du lies in the local frame (Basis::from_normal) about the normal,
/// and that of a fibre where across it a curve was met.
void orient_bsdf(Bsdf& bsdf, const Geometry& geometry, const Ray& ray, const Hit& hit, vec3 normal);

} // namespace candela
