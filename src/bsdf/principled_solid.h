#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/principled_lobes.h"

namespace candela {

/// Disney's model of a solid, as light from one direction sees it: diffuse reflection and sheen, a rough
/// interface of metal and dielectric that may refract, and a clearcoat.
///
/// From outside all of it is there. Inside, the share of glass shows its interface alone; the rest is opaque
/// and looks as from outside.
class PrincipledSolid {
public:
  PrincipledSolid(const PrincipledValues& v, vec3 wo, TransportMode mode)
      : v_(v), mode_(mode), wo_(to_side_of({0, 0, 1}, wo)), side_(wo), inside_(wo.z < 0),
        eta_(inside_ ? 1 / v.eta : v.eta), glass_((1 - v.metallic) * v.spec_trans),
        matte_((1 - v.metallic) * (1 - v.spec_trans)), dielectric_(inside_ ? matte_ : 1 - v.metallic),
        sheen_(v.sheen * dielectric_), coat_(v.clearcoat * (inside_ ? 1 - glass_ : 1)),
        facets_(Microfacets::of_roughness(v.roughness, v.anisotropic)) {
    const float cosine = wo_.z;
    const Split split = split_at(cosine);
    float interface = luminance(split.reflected) + luminance(split.refracted);
    interface = std::max(interface, 0.01f); // it may be more at other facets
    const float coat = coat_ * principled::Clearcoat::albedo(cosine);
    const float diffuse =
        matte_ * luminance(v.base_color) + (matte_ > 0 ? sheen_ * principled::sheen_albedo(cosine) : 0);
    const float sum = interface + coat + diffuse;
    p_diffuse_ = diffuse / sum;
    p_coat_ = coat / sum;
    p_interface_ = interface / sum;
  }

  BsdfEval eval_pdf(vec3 wi) const {
    if (wo_.z == 0 || wi.z == 0) return {Spectrum(0), 0};
    if (inside_) wi.z = -wi.z;
    if (wi.z > 0) return reflected(wi);
    if (!(glass_ > 0)) return {Spectrum(0), 0};
    vec3 h = wo_ + eta_ * wi;
    const float length = glm::length(h);
    if (!(length > 0)) return {Spectrum(0), 0};
    return refracted(wi, h * ((eta_ > 1 ? -1 : 1) / length));
  }

  std::optional<BsdfSample> sample(BsdfU u) const {
    if (wo_.z == 0) return std::nullopt;
    if (u.lobe < p_diffuse_) return made(cosine_hemisphere_from_disc(u.disc));
    if (u.lobe < p_diffuse_ + p_coat_) {
      const vec3 h = principled::Clearcoat(v_.clearcoat_gloss).sample(u.disc);
      return made(2 * glm::dot(wo_, h) * h - wo_);
    }
    const bool refracts = glass_ > 0;
    const vec3 h =
        refracts ? facets_.sample_visible_normal(wo_, u.disc) : facets_.sample_reflecting_normal(wo_, u.disc);
    const float cosine = glm::dot(wo_, h);
    const float v = (u.lobe - p_diffuse_ - p_coat_) / p_interface_;
    if (!refracts || v < split_at(cosine).reflecting_share()) return made(2 * cosine * h - wo_);
    const vec3 wi = refract_about(wo_, h, eta_);
    if (!(wi.z < 0)) return std::nullopt;
    const BsdfEval e = refracted(wi, h);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(-side_, wi), e.f_cos / e.pdf, e.pdf, false, eta_};
  }

private:
  /// What facets do that see light at that cosine.
  struct Split {
    Spectrum reflected, refracted;
    /// Of them, how many are sampled to reflect.
    float reflecting_share() const {
      const float r = luminance(reflected), t = luminance(refracted);
      return t > 0 ? r / (r + t) : 1;
    }
  };
  Split split_at(float cosine) const {
    const float cos2 = 1 - (1 - sqr(cosine)) / sqr(eta_);
    const float passes = cos2 > 0 ? fresnel_dielectric_transmittance(cosine, std::sqrt(cos2), eta_) : 0;
    return split_at(cosine, passes);
  }
  Split split_at(float cosine, float passes) const {
    Spectrum reflected = v_.metallic * fresnel_schlick(v_.base_color, cosine) +
                         dielectric_ * principled::dielectric_reflectance(v_, cosine);
    if (inside_) reflected += Spectrum(glass_ * fresnel_dielectric(cosine, eta_));
    return {reflected, glass_ * passes * glm::sqrt(v_.base_color)};
  }

  // In the frame where wo is above; so is wi of what is reflected.

  BsdfEval reflected(vec3 wi) const {
    const vec3 h = glm::normalize(wo_ + wi);
    const float cosine = glm::dot(wo_, h), g1 = facets_.g1(wo_), d = facets_.d(h) / (4 * wo_.z);
    const Split split = split_at(cosine);
    BsdfEval e{split.reflected * (d * g1 * facets_.g1(wi)), 0};
    e.pdf = p_interface_ * (glass_ > 0 ? split.reflecting_share() * g1 * d : facets_.reflection_pdf(wo_, h));
    if (coat_ > 0) {
      const principled::Clearcoat coat(v_.clearcoat_gloss);
      e.f_cos += Spectrum(coat_ * coat.value(wo_, wi, h));
      e.pdf += p_coat_ * coat.pdf(wo_, h);
    }
    if (matte_ > 0) {
      e.f_cos += matte_ * principled::diffuse(v_, wo_, wi, h);
      if (sheen_ > 0) e.f_cos += sheen_ * principled::sheen(v_, wi, h);
      e.pdf += p_diffuse_ * wi.z * kInvPi;
    }
    return e;
  }

  /// As RoughDielectric does (Walter et al. 2007, eqs. 17 and 21).
  BsdfEval refracted(vec3 wi, vec3 h) const {
    const float cos_o = glm::dot(wo_, h), cos_i = glm::dot(wi, h);
    if (!(h.z > 0 && cos_o > 0 && cos_i < 0)) return {Spectrum(0), 0};
    const Split split = split_at(cos_o, fresnel_dielectric_transmittance(cos_o, -cos_i, eta_));
    const float g1 = facets_.g1(wo_);
    const float density =
        g1 * facets_.d(h) * cos_o * sqr(eta_) * -cos_i / (sqr(cos_o + eta_ * cos_i) * wo_.z);
    const float squeeze = mode_ == TransportMode::radiance ? 1 / sqr(eta_) : 1;
    return {split.refracted * (density * facets_.g1(wi) * squeeze),
            p_interface_ * (1 - split.reflecting_share()) * density};
  }

  std::optional<BsdfSample> made(vec3 wi) const {
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = reflected(wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(side_, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  const PrincipledValues& v_;
  TransportMode mode_;
  vec3 wo_;   ///< above
  vec3 side_; ///< wo as it was
  bool inside_;
  float eta_;        ///< of the far side over wo's
  float glass_;      ///< share that refracts
  float matte_;      ///< share that reflects diffusely
  float dielectric_; ///< share whose specular reflection is that of a dielectric from outside
  float sheen_, coat_;
  Microfacets facets_;
  float p_diffuse_, p_coat_, p_interface_; ///< probabilities of the lobes
};

} // namespace candela
