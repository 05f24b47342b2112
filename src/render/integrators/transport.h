#pragma once
// Rays between surfaces: what every integrator needs, whatever it estimates.

#include "render/integrators/media_at.h"
#include "render/integrators/medium_way.h"
#include "render/integrators/ray_counts.h"
#include "render/world/surface_relief.h"
#include "render/world/texture_point.h"
#include "sampling/sampler.h"

namespace candela {

/// Ray from a surface point towards w (unit), clear of the surface's own rounding, at the time of the ray
/// that met the point.
inline Ray spawn_ray(const SurfaceInteraction& s, vec3 w, float time) {
  return {offset_ray_origin(s.position, s.position_error, s.geometric_normal, w), 0, w, kInfinity, time};
}

/// A ray's way through media.
struct MediaPassage {
  MediumStack media;         ///< where the ray is
  Spectrum transmittance{1}; ///< of the way so far
  MediumWay* way = nullptr;  ///< if not null: becomes that way, and `transmittance` is left alone
};

namespace detail {

/// intersect_through_opacity() where anything may be passed or there are media.
bool intersect_through_media(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met, Hit& hit,
                             RayCounts& counts, MediaPassage* passage, const ConeOfRay* cone);

} // namespace detail

/// Given the closest hit of a ray of unit direction (or not `met`): whether the ray ends at a surface. A
/// surface lets it through with the probability 1 - opacity; each crossing has a random number of its own.
/// Surfaces that `passage` hides (MediumStack) are not there. The ray then starts behind the last surface
/// that it passed. `passage`, which is null in scenes without media, is brought to the surface, or to
/// infinity. `cone`, if not null: textures of opacity are filtered over it.
inline bool intersect_through_opacity(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met,
                                      Hit& hit, RayCounts& counts, MediaPassage* passage = nullptr,
                                      const ConeOfRay* cone = nullptr) {
  if (!scene.has_transparency() && passage == nullptr) return met;
  return detail::intersect_through_media(scene, ray, sampler, met, hit, counts, passage, cone);
}
/// The same where the closest hit is not known yet.
inline bool intersect_scene(const RenderScene& scene, Ray& ray, const Sampler& sampler, Hit& hit,
                            RayCounts& counts, MediaPassage* passage = nullptr,
                            const ConeOfRay* cone = nullptr) {
  ++counts.closest;
  const bool met = scene.geometry().accel().intersect(ray, hit);
  return intersect_through_opacity(scene, ray, sampler, met, hit, counts, passage, cone);
}

/// The end of a shadow ray.
struct ShadowTarget {
  vec3 point;    ///< at t = 1 of the ray, but for rounding; unused if `infinite`
  bool infinite; ///< the ray does not end
};
/// Share of the light that comes through where a shadow ray goes: 0 or 1, or the product of what the
/// transparent surfaces and the media there let pass. `media` of its origin are null in scenes without any.
/// `unscattered`, if not null, becomes the share that media which scatter let pass, as MediumPoint has it.
Spectrum transmittance(const RenderScene& scene, const Ray& ray, const ShadowTarget& target,
                       const Sampler& sampler, RayCounts& counts, const MediumStack* media = nullptr,
                       Spectrum* unscattered = nullptr);

namespace detail {

bool is_occluded_by_unhidden(const RenderScene& scene, Ray ray, MediumStack media, RayCounts& counts);

} // namespace detail

/// Whether a ray of unit direction that starts in `media` meets any surface that those do not hide, and that
/// is no invisible one.
inline bool is_occluded(const RenderScene& scene, const Ray& ray, const MediumStack& media,
                        RayCounts& counts) {
  if (scene.has_priorities() || scene.has_invisible())
    return detail::is_occluded_by_unhidden(scene, ray, media, counts);
  ++counts.shadow;
  return scene.geometry().accel().occluded(ray);
}

/// Gives the BSDF of a surface, which `media` lie on either side of, what it has outside: where its inside
/// has a priority.
inline void set_outside(const RenderScene& scene, const SurfaceMaterial& material, const MediumStack& media,
                        bool from_outside, Bsdf& bsdf) {
  if (material.media.inside.priority > 0)
    set_outside_ior(bsdf, scene.ior(media.outside_of(material.media, from_outside)));
}

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
  return std::abs(glm::dot(normal, geometric_normal)) < 1 - 1e-6f && !is_diffuse(bsdf_flags(bsdf));
}

/// A hit made ready for scattering.
struct Vertex {
  SurfaceInteraction surface;
  const SurfaceMaterial* material;
  vec3 wo;     ///< unit, where the ray came from
  float side;  ///< cosine of wo with the geometric normal: > 0 outside
  Basis frame; ///< about the shading normal
  vec3 wo_local;
  LightSamplingContext light_context;
  float time; ///< of the ray

  /// Made in place: copies of what has just been written by parts stall the processor.
  Vertex(const RenderScene& scene, const Ray& ray, const Hit& hit)
      : surface(scene.geometry().surface(ray, hit)),
        material(
            &facing(scene.material(surface.material), glm::dot(ray.direction, surface.geometric_normal) < 0)),
        wo(-ray.direction), side(glm::dot(wo, surface.geometric_normal)),
        frame(Basis::from_normal(
            visible_normal(shading_normal_at(*material, scene, ray, hit, surface), wo, side))),
        wo_local(frame.to_local(wo)), light_context{surface.position, side > 0 ? surface.geometric_normal
                                                                               : -surface.geometric_normal},
        time(ray.time) {}

  /// Whether anything scatters here: not where the surface is seen edge-on.
  bool scatters() const { return wo_local.z * side > 0; }
  /// Whether a scattered direction stays on the side of the surface that its reflection or refraction means;
  /// the interpolated normal may take it through.
  bool keeps_side(vec3 wi, bool reflected) const {
    return (glm::dot(wi, surface.geometric_normal) * side > 0) == reflected;
  }
};

} // namespace candela
