#include "render/integrators/vertex_lanes.h"

#include "render/world/surface_relief.h"
#include "render/world/triangle_point.h"

namespace candela {

namespace {

/// Triangles in world space and where they were hit.
struct TriangleLanes {
  Vec3Lanes p0, p1, p2;
  Vec3Lanes smooth; ///< TriangleSet::smooth_normal
  Lanes<float> u, v;

  void clear(std::size_t i) {
    for (Vec3Lanes* lanes : {&p0, &p1, &p2, &smooth}) lanes->set(i, vec3(0));
    u[i] = v[i] = 0;
  }
};

/// `normal` becomes the shading normal, not bent to any viewer yet.
[[gnu::noinline]] void set_points(TriangleLanes& __restrict t, VertexLanes& __restrict out) {
  for (std::size_t i = 0; i < out.count; ++i) {
    TrianglePoint p = triangle_point(t.p0[i], t.p1[i], t.p2[i], t.u[i], t.v[i]);
    out.position.set(i, p.position);
    out.position_error.set(i, p.error);
    out.geometric_normal.set(i, p.normal);
    out.normal.set(i, shading_normal(t.smooth[i], p.normal));
  }
}

/// The rest, as seen from wo.
[[gnu::noinline]] void set_frames(const Vec3Lanes& __restrict wo, VertexLanes& __restrict out) {
  for (std::size_t i = 0; i < out.count; ++i) {
    vec3 viewer = wo[i];
    float side = glm::dot(viewer, out.geometric_normal[i]);
    vec3 normal = visible_normal(out.normal[i], viewer, side);
    out.side[i] = side;
    out.normal.set(i, normal);
    out.wo_local.set(i, Basis::from_normal(normal).to_local(viewer));
  }
}

/// The side of a material that a ray of that direction sees, of one that has two.
[[gnu::noinline]] const SurfaceMaterial& seen_side(const SurfaceMaterial& material, const Geometry& geometry,
                                                   const Ray& ray, const Hit& hit) {
  return facing(material, glm::dot(ray.direction, geometry.surface(ray, hit).geometric_normal) < 0);
}

/// Tells anisotropic closures where their surface's tangents lie.
[[gnu::noinline]] void orient(VertexLanes& out, const Geometry& geometry, std::span<const Ray* const> rays,
                              std::span<const Hit> hits) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const SurfaceMaterial& material = *out.material[i];
    if (!material.oriented) continue;
    if (material.textured == nullptr) out.varying[i] = material.bsdf;
    orient_bsdf(out.varying[i], geometry, *rays[i], hits[i], out.normal[i]);
  }
}

} // namespace

void VertexLanes::set(const RenderScene& scene, std::span<const Ray* const> rays, std::span<const Hit> hits,
                      std::span<const MediumStack* const> media, std::span<const ConeOfRay* const> cones) {
  const Geometry& geometry = scene.geometry();
  const TriangleSet& world = geometry.world();
  TriangleLanes triangles;
  Vec3Lanes wo{};                               // g++ does not see that all that are read are set
  std::array<std::uint32_t, kLaneCount> others; // hits of anything else
  std::size_t other_count = 0;
  bool any_oriented = false;
  count = hits.size();
  blends.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Hit& hit = hits[i];
    wo.set(i, -rays[i]->direction);
    time[i] = rays[i]->time;
    material[i] = &scene.material(geometry.material_of(hit));
    if (material[i]->back != nullptr) material[i] = &seen_side(*material[i], geometry, *rays[i], hit);
    any_oriented |= material[i]->oriented;
    if (hit.kind != PrimitiveKind::triangle || hit.instance != kNoInstance || material[i]->is_textured) {
      others[other_count++] = i;
      triangles.clear(i);
      continue;
    }
    const uvec3 t = world.triangles[hit.primitive];
    triangles.p0.set(i, world.positions[t.x]);
    triangles.p1.set(i, world.positions[t.y]);
    triangles.p2.set(i, world.positions[t.z]);
    triangles.u[i] = hit.u;
    triangles.v[i] = hit.v;
    triangles.smooth.set(i, world.smooth_normal(t, hit.u, hit.v));
  }
  set_points(triangles, *this);
  for (std::uint32_t i : std::span(others.data(), other_count)) {
    const SurfaceInteraction s = geometry.surface(*rays[i], hits[i]);
    position.set(i, s.position);
    position_error.set(i, s.position_error);
    geometric_normal.set(i, s.geometric_normal);
    const ConeOfRay* relief_cone = cones.empty() ? nullptr : cones[i];
    normal.set(i, shading_normal_at(*material[i], scene, *rays[i], hits[i], s, relief_cone));
    if (material[i]->textured == nullptr) continue;
    const ConeOfRay* cone = !cones.empty() && material[i]->textured->is_filtered ? cones[i] : nullptr;
    varying[i] = evaluate_bsdf(
        *material[i], texture_point(scene, *rays[i], hits[i], cone, material[i]->asks_place), blends);
  }
  set_frames(wo, *this);
  if (any_oriented) orient(*this, geometry, rays, hits);
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (material[i]->media.inside.priority <= 0) continue;
    if (material[i]->textured == nullptr && !material[i]->oriented) varying[i] = material[i]->bsdf;
    set_outside(scene, *material[i], *media[i], side[i] > 0, varying[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    LightSamplingContext& context = light_context[i];
    context.position = position[i];
    context.domain = ScatteringDomain::hemisphere;
    context.normal = side[i] > 0 ? geometric_normal[i] : -geometric_normal[i];
  }
}

namespace {

/// A direction and its mirror image about the surface's plane, in local coordinates, and whether each keeps
/// the side of the surface that it means.
struct MirroredPair {
  vec3 mirrored;
  bool keeps, mirrored_keeps;
};
MirroredPair mirrored_pair(const VertexLanes& v, std::size_t i, vec3 wi_local) {
  const Basis frame = Basis::from_normal(v.normal[i]);
  const vec3 outside = v.geometric_normal[i], wi = frame.to_world(wi_local);
  const float along = glm::dot(wi, outside) * v.side[i], reflected = v.wo_local.z[i];
  const vec3 mirrored = frame.to_local(mirrored_at_plane(wi, outside));
  return {mirrored, (along > 0) == (wi_local.z * reflected > 0), (along < 0) == (mirrored.z * reflected > 0)};
}

} // namespace

BsdfEval VertexLanes::folded_eval_pdf(std::size_t i, vec3 wi_local, DirectionSampling how,
                                      const BsdfEval& own) const {
  const MirroredPair pair = mirrored_pair(*this, i, wi_local);
  BsdfEval sum{Spectrum(0), 0};
  auto add = [&](const BsdfEval& e) { sum = {sum.f_cos + e.f_cos, sum.pdf + e.pdf}; };
  if (pair.keeps) add(own);
  if (!pair.mirrored_keeps) add(direction_eval_pdf(bsdf(i), wo_local[i], pair.mirrored, how));
  return sum;
}

float VertexLanes::folded_pdf(std::size_t i, vec3 wi_local, DirectionSampling how) const {
  const MirroredPair pair = mirrored_pair(*this, i, wi_local);
  return pair.keeps != pair.mirrored_keeps ? direction_pdf(bsdf(i), wo_local[i], pair.mirrored, how) : 0;
}

void VertexLanes::set_in_medium(std::size_t i, vec3 point, vec3 direction, float at_time,
                                const PhaseFunction& phase) {
  // No surface: it bounds nothing, and its BSDF is that of the lane.
  static const SurfaceMaterial nowhere = [] {
    SurfaceMaterial none;
    none.varies = true;
    return none;
  }();
  position.set(i, point);
  position_error.set(i, vec3(0));
  geometric_normal.set(i, -direction);
  normal.set(i, -direction);
  wo_local.set(i, {0, 0, 1});
  side[i] = 1;
  time[i] = at_time;
  light_context[i] = LightSamplingContext::in_volume(point);
  material[i] = &nowhere;
  varying[i] = VolumeScattering{phase};
}

void VertexLanes::set_one(const Vertex& vertex, const Bsdf& bsdf) {
  count = 1;
  position.set(0, vertex.surface.position);
  position_error.set(0, vertex.surface.position_error);
  geometric_normal.set(0, vertex.surface.geometric_normal);
  normal.set(0, vertex.frame.n);
  wo_local.set(0, vertex.wo_local);
  side[0] = vertex.side;
  time[0] = vertex.time;
  light_context[0] = vertex.light_context;
  material[0] = vertex.material;
  varying[0] = bsdf;
}

} // namespace candela
