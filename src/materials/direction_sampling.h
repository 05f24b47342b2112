#pragma once
// Strategies for sampling directions: by the BSDF, or over the hemisphere, to compare their noise.

#include "materials/bsdf.h"
#include "sampling/direction_type.h"

namespace candela {

namespace detail {

/// Density in 1/sr over the hemisphere on wo's side; over both, each with half of it, of what transmits with
/// a density.
inline float strategy_pdf(vec3 wo, vec3 wi, DirectionSampling how, bool both_sides) {
  if (!both_sides && !same_hemisphere(wo, wi)) return 0;
  const float pdf =
      how == DirectionSampling::uniform ? kUniformHemispherePdf : cosine_hemisphere_pdf(std::abs(wi.z));
  return both_sides ? 0.5f * pdf : pdf;
}

/// A direction of that density. u_side in [0, 1) chooses the side, if there are two.
inline vec3 strategy_direction(vec3 wo, vec2 disc, float u_side, DirectionSampling how, bool both_sides) {
  const vec3 wi =
      how == DirectionSampling::uniform ? uniform_cone_from_disc(disc, 1) : cosine_hemisphere_from_disc(disc);
  return to_side_of(both_sides && u_side < 0.5f ? -wo : wo, wi);
}

} // namespace detail

/// f |cos| and the density of wi under sample_direction, both without delta lobes.
inline BsdfEval direction_eval_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi, DirectionSampling how) {
  if (how == DirectionSampling::bsdf) return bsdf_eval_pdf(bsdf, wo, wi);
  float other_probability = 1 - bsdf_delta_probability(bsdf, wo);
  const bool both_sides = transmits_with_density(bsdf_flags(bsdf));
  return {bsdf_eval(bsdf, wo, wi), other_probability * detail::strategy_pdf(wo, wi, how, both_sides)};
}

inline float direction_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi, DirectionSampling how) {
  return direction_eval_pdf(bsdf, wo, wi, how).pdf;
}

namespace detail {

/// sample_direction() for `uniform` and `cosine`; a separate function, so that the other one is small enough
/// to be inlined.
[[gnu::noinline]] inline std::optional<BsdfSample> sample_by_strategy(const Bsdf& bsdf, vec3 wo, BsdfU u,
                                                                      DirectionSampling how) {
  const float delta = bsdf_delta_probability(bsdf, wo);
  if (u.lobe < delta) return bsdf_sample(bsdf, wo, u);
  const bool both_sides = transmits_with_density(bsdf_flags(bsdf));
  const float u_side = (u.lobe - delta) / (1 - delta); // uniform again
  vec3 wi = strategy_direction(wo, u.disc, u_side, how, both_sides);
  BsdfEval e = direction_eval_pdf(bsdf, wo, wi, how);
  if (!(e.pdf > 0) || is_black(e.f_cos)) return std::nullopt;
  return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false};
}

} // namespace detail

/// As BsdfModel::sample, but with `uniform` and `cosine` the lobes without delta are sampled over the
/// hemisphere on wo's side, or over both where such a lobe transmits. Delta lobes are still sampled with
/// delta_probability, since no other density finds them; so all strategies have the same expectation.
[[gnu::always_inline]] inline std::optional<BsdfSample> sample_direction(const Bsdf& bsdf, vec3 wo, BsdfU u,
                                                                         DirectionSampling how) {
  if (how == DirectionSampling::bsdf) return bsdf_sample(bsdf, wo, u);
  return detail::sample_by_strategy(bsdf, wo, u, how);
}

} // namespace candela
