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
  const bool projected = bump.use.mapping == TextureMapping::triplanar;
  auto most = [](vec2 v) { return std::max(std::abs(v.x), std::abs(v.y)); };
  auto along = [&](vec2 axis, vec3 derivative) {
    const float texels = projected
                             ? max_component(glm::abs(derivative)) * most(bump.use.uv.scale) * most(cells)
                             : most(bump.use.uv.apply_to_step(axis) * cells);
    const float step = 0.5f / std::max(texels, 1.0f);
    return (bump.number(at.moved(step * axis)) - bump.number(at.moved(-step * axis))) / (2 * step);
  };
  const SurfacePlace place = at.place.value_or(SurfacePlace());
  return {along({1, 0}, place.dpdu), along({0, 1}, place.dpdv)};
}

/// The normal by a map that is projected along the object's axes: each projection's slopes lie along its own
/// axes. Slopes are gradients, which are transformed as normals are.
vec3 triplanar_normal(const TexturedParameter& map, const TexturePoint& at, const mat4& world_from_object,
                      vec3 geometric) {
  constexpr float kSteepest = 1e-3f; // cosine
  const vec3 normal = at.place->normal;
  vec3 slope(0);
  for (const ProjectedPoint& p : project_triplanar(*at.place, at.footprint, map.use.blend)) {
    if (!(p.weight > 0)) continue;
    const vec3 n = 2.0f * map.color(p.at) - 1.0f;
    slope += p.weight / std::max(n.z, kSteepest) * (n.x * p.across + n.y * p.up);
  }
  slope -= glm::dot(slope, normal) * normal;
  const mat3 normal_to_world = glm::transpose(glm::inverse(mat3(world_from_object)));
  return kept_above(glm::normalize(normal_to_world * (normal + slope)), geometric);
}

/// Whether a lookup needs texture coordinates that the surface has not.
bool lacks_uv(const TexturedParameter* lookup, const SurfaceTangents& tangents) {
  return lookup == nullptr || (!tangents.has_uv && lookup->use.mapping == TextureMapping::uv);
}

} // namespace

vec3 relief_normal(const SurfaceMaterial& material, const RenderScene& scene, const Ray& ray, const Hit& hit,
                   const SurfaceInteraction& surface, const ConeOfRay* cone) {
  const Geometry& geometry = scene.geometry();
  const SurfaceTangents tangents = geometry.tangents(ray, hit);
  const TexturedParameter *bump = material.bump_texture, *map = material.normal_texture;
  if (lacks_uv(bump, tangents) && lacks_uv(map, tangents)) return surface.shading_normal;
  const TexturePoint at = texture_point(scene, ray, hit, cone, material.asks_place);
  vec3 normal = surface.shading_normal;
  if (!lacks_uv(bump, tangents))
    normal = bumped_normal(normal, surface.geometric_normal, tangents.dpdu, tangents.dpdv,
                           height_gradient(*bump, at));
  if (lacks_uv(map, tangents)) return normal;
  if (map->use.mapping == TextureMapping::triplanar)
    return triplanar_normal(*map, at,
                            world_from_object(scene.instances()[geometry.instance_of(hit)], ray.time),
                            surface.geometric_normal);
  return mapped_normal(texture_basis(normal, tangents.dpdu, tangents.dpdv), surface.geometric_normal,
                       map->color(at));
}

void orient_bsdf(Bsdf& bsdf, const Geometry& geometry, const Ray& ray, const Hit& hit, vec3 normal) {
  if (!is_anisotropic(bsdf)) return;
  set_tangent(bsdf, vec2(Basis::from_normal(normal).to_local(geometry.tangents(ray, hit).dpdu)));
  if (hit.kind == PrimitiveKind::curve) set_fibre_offset(bsdf, 2 * geometry.uv(ray, hit).y - 1);
}

} // namespace candela
