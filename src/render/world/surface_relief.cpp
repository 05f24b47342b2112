#include "render/world/surface_relief.h"

#include "core/basis.h"
#include "materials/normal_map.h"
#include "render/world/texture_point.h"

namespace candela {

namespace {

/// Height over the surface around a place: central differences over half a texel, which is as much as the
/// blend of texels resolves.
vec2 height_gradient(const TexturedParameter& bump, const TexturePoint& at) {
  const vec2 cells = std::visit([](const auto& kind) { return kind.cells(); }, bump.texture->model);
  auto along = [&](vec2 axis) {
    const vec2 texels = glm::abs(bump.use.uv.apply_to_step(axis)) * cells;
    const float step = 0.5f / std::max({texels.x, texels.y, 1.0f});
    TexturePoint before = at, after = at;
    before.uv -= step * axis, after.uv += step * axis;
    return (bump.number(after) - bump.number(before)) / (2 * step);
  };
  return {along({1, 0}), along({0, 1})};
}

} // namespace

vec3 relief_normal(const SurfaceMaterial& material, const Geometry& geometry, const Ray& ray, const Hit& hit,
                   const SurfaceInteraction& surface, const ConeOfRay* cone) {
  const SurfaceTangents tangents = geometry.tangents(ray, hit);
  if (!tangents.has_uv) return surface.shading_normal;
  const TexturePoint at = texture_point(geometry, ray, hit, cone);
  vec3 normal = surface.shading_normal;
  if (material.bump_texture != nullptr)
    normal = bumped_normal(normal, surface.geometric_normal, tangents.dpdu, tangents.dpdv,
                           height_gradient(*material.bump_texture, at));
  if (material.normal_texture != nullptr)
    normal = mapped_normal(texture_basis(normal, tangents.dpdu, tangents.dpdv), surface.geometric_normal,
                           material.normal_texture->color(at));
  return normal;
}

void orient_bsdf(Bsdf& bsdf, const Geometry& geometry, const Ray& ray, const Hit& hit, vec3 normal) {
  if (!is_anisotropic(bsdf)) return;
  set_tangent(bsdf, vec2(Basis::from_normal(normal).to_local(geometry.tangents(ray, hit).dpdu)));
  if (hit.kind == PrimitiveKind::curve) set_fibre_offset(bsdf, 2 * geometry.uv(ray, hit).y - 1);
}

} // namespace candela
