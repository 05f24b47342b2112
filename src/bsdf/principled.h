#pragma once

#include "bsdf/principled_solid.h"
#include "bsdf/principled_thin.h"

namespace candela {

/// Disney's "principled" BSDF in the form of Mitsuba 3's "principled" and, as a sheet, "principledthin".
/// Reciprocal. It is made for its looks and may give back more light than it got: a white surface 1.5 times
/// as much in grazing directions where it is rough, by its retro-reflection, and up to 1.7 times with sheen
/// and clearcoat, which are added to what is below them. Glass and metal do not; they lose what is scattered
/// more than once between facets. Sampled as a mixture of its lobes, which are chosen by about how much light
/// from wo each reflects.
struct Principled : PrincipledValues {
  Spectrum eval(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    return eval_pdf(wo, wi, mode).f_cos;
  }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }
  BsdfEval eval_pdf(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    return thin ? PrincipledThin(*this, wo).eval_pdf(wi) : PrincipledSolid(*this, wo, mode).eval_pdf(wi);
  }
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) const {
    return thin ? PrincipledThin(*this, wo).sample(u) : PrincipledSolid(*this, wo, mode).sample(u);
  }

  bool is_isotropic() const { return anisotropic == 0; }
  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const {
    BsdfFlags flags = BsdfFlags::reflection | BsdfFlags::glossy;
    if (matte() > 0) flags |= BsdfFlags::diffuse;
    if (transmits() > 0) flags |= BsdfFlags::transmission;
    return flags;
  }
  LobeProxy lobe_proxy(vec3 wo) const {
    const float cosine = std::abs(wo.z), metal = thin ? 0 : metallic;
    const Spectrum reflectance = metal * fresnel_schlick(base_color, cosine) +
                                 (1 - metal) * principled::dielectric_reflectance(*this, cosine);
    LobeProxy proxy = facet_lobe_proxy(Microfacets::of_roughness(roughness, anisotropic), wo,
                                       (thin ? spec_trans : 1) * luminance(reflectance));
    proxy.diffuse += kInvPi * (matte() * (luminance(base_color) + sheen * principled::sheen_albedo(cosine)) +
                               0.5f * transmits() + (thin ? 0 : clearcoat * 0.01f) + 1e-3f);
    return proxy;
  }
  Spectrum albedo() const { return base_color; }

private:
  float matte() const { return thin ? 1 - spec_trans : (1 - metallic) * (1 - spec_trans); }
  float transmits() const {
    return thin ? std::max(spec_trans, 0.5f * diff_trans * (1 - spec_trans)) : (1 - metallic) * spec_trans;
  }
};

} // namespace candela
