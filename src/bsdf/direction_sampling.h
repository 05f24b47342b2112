#pragma once
// Scattered directions by strategy: the BSDF's own, or over the hemisphere, to compare what they cost in
// noise.

#include "bsdf/bsdf.h"
#include "sampling/direction_type.h"

namespace candela {

namespace detail {

/// Density in 1/sr over the hemisphere on wo's side.
inline float hemisphere_pdf(vec3 wo, vec3 wi, DirectionSampling how) {
  if (!same_hemisphere(wo, wi)) return 0;
  return how == DirectionSampling::uniform ? kUniformHemispherePdf : cosine_hemisphere_pdf(std::abs(wi.z));
}

} // namespace detail

/// f |cos| and the density of wi under sample_direction, both without delta lobes.
inline BsdfEval direction_eval_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi, DirectionSampling how) {
  if (how == DirectionSampling::bsdf) return bsdf_eval_pdf(bsdf, wo, wi);
  float other_probability = 1 - bsdf_delta_probability(bsdf, wo);
  return {bsdf_eval(bsdf, wo, wi), other_probability * detail::hemisphere_pdf(wo, wi, how)};
}

inline float direction_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi, DirectionSampling how) {
  return direction_eval_pdf(bsdf, wo, wi, how).pdf;
}

/// As BsdfModel::sample, but with `uniform` and `cosine` the lobes without delta are sampled over the
/// hemisphere on wo's side (all such lobes reflect). Delta lobes are still taken with delta_probability, for
/// no other density ever meets them; so every strategy has the same expectation.
inline std::optional<BsdfSample> sample_direction(const Bsdf& bsdf, vec3 wo, BsdfU u, DirectionSampling how) {
  if (how == DirectionSampling::bsdf || u.lobe < bsdf_delta_probability(bsdf, wo))
    return bsdf_sample(bsdf, wo, u);
  vec3 wi = how == DirectionSampling::uniform ? uniform_cone_from_disc(u.disc, 1)
                                              : cosine_hemisphere_from_disc(u.disc);
  wi = to_side_of(wo, wi);
  BsdfEval e = direction_eval_pdf(bsdf, wo, wi, how);
  if (!(e.pdf > 0) || is_black(e.f_cos)) return std::nullopt;
  return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false};
}

} // namespace candela
