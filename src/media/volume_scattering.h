#pragma once

#include "bsdf/bsdf_sample.h"
#include "core/basis.h"
#include "media/phase_function.h"

namespace candela {

/// Scattering at a point in a medium as a closure (BsdfModel): the phase function, with no cosine in it.
/// Paths have multiplied by the albedo already. The frame's normal means nothing to it.
struct VolumeScattering {
  PhaseFunction phase;

  Spectrum eval(vec3 wo, vec3 wi) const { return Spectrum(pdf(wo, wi)); }
  float pdf(vec3 wo, vec3 wi) const { return phase_eval(phase, Turn::between(wo, wi)); }
  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    const float p = pdf(wo, wi);
    return {Spectrum(p), p};
  }
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    // The square of the radius is uniform. Of the disc's centre is made the direction straight on.
    const float r2 = glm::dot(u.disc, u.disc);
    const Turn turn = phase_sample(phase, std::min(r2, 1 - 0x1p-24f), u.lobe);
    const float r = std::sqrt(r2);
    const vec2 around = r > 0 ? u.disc / r : vec2(1, 0);
    const vec3 wi = Basis::from_normal(-wo).to_world({turn.sine() * around, turn.cosine()});
    return BsdfSample{wi, Spectrum(1), phase_eval(phase, turn), false};
  }
  float delta_probability(vec3) const { return 0; }
  /// `mixed`: the lobe's number chooses among several functions.
  BsdfFlags flags() const {
    return BsdfFlags::reflection | BsdfFlags::transmission | BsdfFlags::diffuse | BsdfFlags::mixed;
  }
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const { return Spectrum(1); }
};

static_assert(BsdfModel<VolumeScattering>);

} // namespace candela
