#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/principled_lobes.h"

namespace candela {

/// Disney's model of a sheet (Burley 2015, section 5.3), alike from both sides, as light from one direction
/// sees it: diffuse reflection and transmission, a rough mirror, and glass that bends nothing but scatters
/// as its mirror image would, with facets made flatter by the index (Burley 2015, figure 15).
///
/// Mitsuba leaves out transmission between grazing directions whose flipped half vector does not lie between
/// them; here it is the mirror image of a reflection everywhere.
class PrincipledThin {
public:
  PrincipledThin(const PrincipledValues& v, vec3 wo)
      : v_(v), wo_(to_side_of({0, 0, 1}, wo)), side_(wo),
        matte_((1 - v.spec_trans) * (1 - 0.5f * v.diff_trans)),
        passes_((1 - v.spec_trans) * 0.5f * v.diff_trans),
        mirror_(Microfacets::of_roughness(v.roughness, v.anisotropic)),
        glass_(Microfacets::of_roughness((0.65f * v.eta - 0.35f) * v.roughness, v.anisotropic)) {
    const float cosine = wo_.z, base = luminance(v.base_color);
    // No facet's reflectance is 0 but where no light is to be had at all, nor does any reflect everything.
    const float reflects = luminance(principled::dielectric_reflectance(v, cosine));
    p_mirror_ = v.spec_trans * std::max(reflects, 0.01f);
    p_glass_ = v.spec_trans * base * std::max(1 - fresnel_dielectric(cosine, v.eta), 0.01f);
    p_matte_ = matte_ * (base + v.sheen * principled::sheen_albedo(cosine));
    p_passes_ = passes_ * base;
    const float sum = p_mirror_ + p_glass_ + p_matte_ + p_passes_;
    if (!(sum > 0)) return;
    for (float* p : {&p_mirror_, &p_glass_, &p_matte_, &p_passes_}) *p /= sum;
  }

  BsdfEval eval_pdf(vec3 wi) const {
    if (wo_.z == 0 || wi.z == 0) return {Spectrum(0), 0};
    const bool transmits = side_.z * wi.z < 0;
    return value(to_side_of({0, 0, 1}, wi), transmits);
  }

  std::optional<BsdfSample> sample(BsdfU u) const {
    if (wo_.z == 0) return std::nullopt;
    float v = u.lobe;
    if (v < p_mirror_) return mirrored(mirror_, u.disc, false);
    if (v -= p_mirror_; v < p_glass_) return mirrored(glass_, u.disc, true);
    const bool transmits = (v -= p_glass_) >= p_matte_;
    return made(cosine_hemisphere_from_disc(u.disc), transmits && p_passes_ > 0);
  }

private:
  /// wi above, or its mirror image.
  BsdfEval value(vec3 wi, bool transmits) const {
    const vec3 h = glm::normalize(wo_ + wi);
    const Microfacets& facets = transmits ? glass_ : mirror_;
    const float p = transmits ? p_glass_ : p_mirror_;
    BsdfEval e{Spectrum(0), 0};
    if (v_.spec_trans > 0) {
      const float cosine = glm::dot(wo_, h);
      const Spectrum share = transmits ? v_.base_color * (1 - fresnel_dielectric(cosine, v_.eta))
                                       : principled::dielectric_reflectance(v_, cosine);
      e.f_cos = share * (v_.spec_trans * facets.d(h) * facets.g1(wo_) * facets.g1(wi) / (4 * wo_.z));
      e.pdf = p * facets.reflection_pdf(wo_, h);
    }
    if (transmits) {
      e.f_cos += v_.base_color * (passes_ * wi.z * kInvPi);
    } else if (matte_ > 0) {
      e.f_cos += matte_ * principled::diffuse(v_, wo_, wi, h);
      if (v_.sheen > 0) e.f_cos += matte_ * v_.sheen * principled::sheen(v_, wi, h);
    }
    e.pdf += (transmits ? p_passes_ : p_matte_) * wi.z * kInvPi;
    return e;
  }

  std::optional<BsdfSample> mirrored(const Microfacets& facets, vec2 disc, bool transmits) const {
    const vec3 h = facets.sample_reflecting_normal(wo_, disc);
    return made(2 * glm::dot(wo_, h) * h - wo_, transmits);
  }
  std::optional<BsdfSample> made(vec3 wi, bool transmits) const {
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = value(wi, transmits);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(transmits ? -side_ : side_, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  const PrincipledValues& v_;
  vec3 wo_;              ///< above
  vec3 side_;            ///< wo as it was
  float matte_, passes_; ///< shares that reflect and transmit diffusely
  Microfacets mirror_, glass_;
  float p_mirror_, p_glass_, p_matte_, p_passes_; ///< probabilities of the lobes
};

} // namespace candela
