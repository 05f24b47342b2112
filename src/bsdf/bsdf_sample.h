#pragma once
// The interface of all scattering models.
//
// Directions are unit vectors in the local frame whose +z is the shading normal, and both point away from the
// surface. Reflecting models are two-sided: below the surface (wo.z < 0) they act as above it, mirrored.

#include "bsdf/bsdf_flags.h"
#include "bsdf/lobe_proxy.h"
#include "core/spectrum.h"
#include "sampling/warp.h"

#include <concepts>
#include <optional>

namespace candela {

/// The random numbers that select a direction. All models map the same disc, so its points can be computed
/// for many samples at once.
struct BsdfU {
  vec2 disc;  ///< uniform on the unit disc; chooses the direction
  float lobe; ///< in [0, 1); chooses the lobe

  BsdfU(vec2 on_disc, float u) : disc(on_disc), lobe(u) {}
  /// From [0, 1)^3: the direction by x and y, the lobe by z.
  BsdfU(vec3 u) : disc(sample_uniform_disc({u.x, u.y})), lobe(u.z) {}
};

struct BsdfSample {
  vec3 wi;
  /// f(wo, wi) |cos theta_i| / pdf, with every probability of the choice in it (the lobe's, too).
  Spectrum weight;
  /// Of a non-delta lobe: density of wi in 1/sr, as BsdfModel::pdf gives it. Of a delta lobe: the probability
  /// of having chosen it (no density; do not combine it by MIS).
  float pdf;
  bool delta;
  /// Refractive index on wi's side over that on wo's side; 1 for reflection. Under TransportMode::radiance
  /// the weight of a refraction has a factor 1 / eta^2 in it, which Russian roulette should undo.
  float eta = 1;
};

struct BsdfEval {
  Spectrum f_cos; ///< f(wo, wi) |cos theta_i|, 1/sr
  float pdf;      ///< 1/sr
};

/// - eval: f(wo, wi) |cos theta_i| in 1/sr of the part without delta lobes.
/// - pdf: density in 1/sr with which sample() gives wi by a lobe without delta. Over the sphere it
///   integrates to 1 - delta_probability(wo), less the probability that sample() fails.
/// - eval_pdf: both at once.
/// - sample: a delta lobe exactly where u.lobe < delta_probability(wo). Nothing where it finds no direction
///   that pdf() knows, or a delta lobe that carries no light: it counts as a sample of value 0. Directions of
///   a density are given even if no light comes from there, for in a mixture another model may have some.
/// - delta_probability: with which sample() takes a delta lobe (0: there is none, 1: there is nothing else).
/// - flags: what it does at all, see BsdfFlags.
/// - lobe_proxy: roughly how much it reflects from where, for choosing a light.
/// - albedo: rough reflectance, for the albedo view only.
///
/// Models that are not symmetric in wo and wi (those that refract) take a TransportMode as the last argument
/// of sample(), and of eval() and eval_pdf() if they have more than delta lobes.
template <class B>
concept BsdfModel = requires(const B& b, vec3 wo, vec3 wi, BsdfU u) {
  { b.eval(wo, wi) } -> std::same_as<Spectrum>;
  { b.pdf(wo, wi) } -> std::same_as<float>;
  { b.eval_pdf(wo, wi) } -> std::same_as<BsdfEval>;
  { b.sample(wo, u) } -> std::same_as<std::optional<BsdfSample>>;
  { b.delta_probability(wo) } -> std::same_as<float>;
  { b.flags() } -> std::same_as<BsdfFlags>;
  { b.lobe_proxy(wo) } -> std::same_as<LobeProxy>;
  { b.albedo() } -> std::same_as<Spectrum>;
};

/// Whether both are on the same side of the surface, and neither in its plane.
inline bool same_hemisphere(vec3 wo, vec3 wi) { return wo.z * wi.z > 0; }
/// The mirror image of wo about the normal.
inline vec3 reflect_about_normal(vec3 wo) { return {-wo.x, -wo.y, wo.z}; }
/// w with its z mirrored to the side of the surface on which `side` lies.
inline vec3 to_side_of(vec3 side, vec3 w) { return {w.x, w.y, std::copysign(w.z, side.z)}; }

} // namespace candela
