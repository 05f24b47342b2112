#pragma once
// Rays between surfaces: what every integrator needs, whatever it estimates.

#include "render/integrators/interior.h"
#include "render/integrators/ray_counts.h"
#include "sampling/sampler.h"

namespace candela {

/// Ray from a surface point towards w (unit), clear of the surface's own rounding.
inline Ray spawn_ray(const Surface& s, vec3 w) {
  return {offset_ray_origin(s.position, s.position_error, s.geometric_normal, w), 0, w, kInfinity};
}

/// A ray's way through bodies that absorb.
struct Passage {
  Interiors interiors;   ///< where the ray is
  vec3 transmittance{1}; ///< what is left of the light on the way so far
};

namespace detail {

/// look_through() where anything is transparent or absorbs.
bool look_through_bodies(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met, Hit& hit,
                         RayCounts& counts, Passage* passage);

} // namespace detail

/// What a ray of unit direction meets first, or (not `met`) that it meets nothing, is known: whether it meets
/// a surface, looking through what is transparent with the chance of 1 - opacity; each crossing has a random
/// number of its own. The ray then starts behind the last one that it passed. `passage`, which is null in
/// scenes without absorption, is brought to the surface, or to infinity.
inline bool look_through(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met, Hit& hit,
                         RayCounts& counts, Passage* passage = nullptr) {
  if (!scene.has_transparency() && passage == nullptr) return met;
  return detail::look_through_bodies(scene, ray, sampler, met, hit, counts, passage);
}
/// The same where it is not known.
inline bool intersect_scene(const RenderScene& scene, Ray& ray, const Sampler& sampler, Hit& hit,
                            RayCounts& counts, Passage* passage = nullptr) {
  ++counts.closest;
  const bool met = scene.geometry().accel().intersect(ray, hit);
  return look_through(scene, ray, sampler, met, hit, counts, passage);
}

/// Share of the light that comes through where the ray goes: 0 or 1, or the product of what the transparent
/// surfaces and the bodies there let pass. The ray leads to t = 1 at `target`, or on for ever if `infinite`.
/// `interiors` of its origin are null in scenes without absorption.
vec3 visibility(const RenderScene& scene, const Ray& ray, vec3 target, bool infinite, RayCounts& counts,
                const Interiors* interiors = nullptr);

/// Weight of the strategy with density `mine` (> 0) against the other's, numbers of samples included (Veach
/// 1997, section 9.2).
inline float mis_weight(MisHeuristic how, float mine, float other) {
  float ratio = other / mine; // squares of densities could overflow, their ratio is what matters
  return 1 / (1 + (how == MisHeuristic::power ? ratio * ratio : ratio));
}

/// The shading normal for a viewer at wo, on whose side of the surface the geometric normal lies if `side` >
/// 0: where the interpolated one looks away it is bent until it just does not, so that smooth meshes have no
/// black slivers along their silhouettes.
inline vec3 visible_normal(vec3 shading_normal, vec3 wo, float side) {
  constexpr float kGrazing = 1e-4f; // cosine
  vec3 viewer = select(side > 0, wo, -wo);
  float cosine = glm::dot(shading_normal, viewer);
  vec3 bent = glm::normalize(shading_normal + (kGrazing - cosine) * viewer);
  return select(cosine >= kGrazing, shading_normal, bent);
}

/// The unit direction w, mirrored at the plane with the unit normal.
inline vec3 mirrored_at_plane(vec3 w, vec3 normal) { return w - 2 * glm::dot(w, normal) * normal; }

/// Whether directions that the shading normal takes to the wrong side of the surface are folded back to the
/// side that they mean, mirrored at the surface: else a coarse smooth mesh of mirror, glass or gloss loses
/// them and is black at its rims. So the lobe about the shading normal is, of a direction w on the right
/// side, f(w) |cos| + f(w*) |cos*| with the mirrored w*, where w* lies on the wrong one: it loses nothing,
/// whatever the normal. Lambertian reflection, of which little lies there, is left as other renderers have
/// it.
inline bool folds_directions(const Bsdf& bsdf, vec3 normal, vec3 geometric_normal) {
  return std::abs(glm::dot(normal, geometric_normal)) < 1 - 1e-6f && !std::holds_alternative<Diffuse>(bsdf);
}

/// A hit made ready for scattering.
struct Vertex {
  Surface surface;
  const SurfaceMaterial* material;
  vec3 wo;     ///< unit, where the ray came from
  float side;  ///< cosine of wo with the geometric normal: > 0 outside
  Basis frame; ///< about the shading normal
  vec3 wo_local;
  LightReference reference; ///< of this point, for aiming at lights

  /// Made in place: copies of what has just been written by parts stall the processor.
  Vertex(const RenderScene& scene, const Ray& ray, const Hit& hit)
      : surface(scene.geometry().surface(ray, hit)), material(&scene.material(surface.material)),
        wo(-ray.direction), side(glm::dot(wo, surface.geometric_normal)),
        frame(Basis::from_normal(visible_normal(surface.shading_normal, wo, side))),
        wo_local(frame.to_local(wo)), reference{
                                          surface.position,
                                          side > 0 ? surface.geometric_normal : -surface.geometric_normal,
                                          false,
                                          false,
                                          {},
                                          vec3(0)} {}

  /// Whether anything scatters here: not where the surface is seen edge-on.
  bool scatters() const { return wo_local.z * side > 0; }
  /// Whether a scattered direction stays on the side of the surface that its reflection or refraction means;
  /// the interpolated normal may take it through.
  bool keeps_side(vec3 wi, bool reflected) const {
    return (glm::dot(wi, surface.geometric_normal) * side > 0) == reflected;
  }
};

} // namespace candela
