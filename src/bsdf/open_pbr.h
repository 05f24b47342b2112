#pragma once

#include "bsdf/open_pbr_layers.h"

namespace candela {

/// OpenPBR Surface 1.1 (Academy Software Foundation) without media, dispersion and thin walls. Layers are put
/// on each other by scaling what is below by what they leave of the light from wo, which the specification
/// calls albedo scaling: not reciprocal, but nothing is gained, and what absorbs nothing loses as little as
/// the tables err. Sampled as a mixture of its lobes, which are chosen by about how much light from wo each
/// reflects.
struct OpenPbr : OpenPbrValues {
  Spectrum eval(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    return eval_pdf(wo, wi, mode).f_cos;
  }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }
  BsdfEval eval_pdf(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    return OpenPbrLayers(*this, wo, mode).eval_pdf(wi);
  }
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) const {
    return OpenPbrLayers(*this, wo, mode).sample(u);
  }

  bool is_isotropic() const { return specular_roughness_anisotropy == 0 && coat_roughness_anisotropy == 0; }
  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const {
    BsdfFlags flags = BsdfFlags::reflection | BsdfFlags::glossy;
    if (base_metalness < 1 && transmission_weight < 1) flags |= BsdfFlags::diffuse;
    if (base_metalness < 1 && transmission_weight > 0) flags |= BsdfFlags::transmission;
    return flags;
  }
  LobeProxy lobe_proxy(vec3 wo) const {
    const float cosine = std::abs(wo.z), plain = 1 - base_metalness;
    const open_pbr::BaseFresnel fresnel(*this);
    const Microfacets base = open_pbr::facets(open_pbr::base_roughness(*this), specular_roughness_anisotropy);
    const Microfacets coat = open_pbr::facets(coat_roughness, coat_roughness_anisotropy);
    const float mirrors = coat_weight * fresnel_dielectric(cosine, coat_ior),
                below =
                    luminance(base_metalness * fresnel.metal(cosine) + plain * fresnel.dielectric(cosine));
    LobeProxy proxy = facet_lobe_proxy(base, wo, (1 - mirrors) * below);
    const LobeProxy above = facet_lobe_proxy(coat, wo, mirrors);
    const float diffuse =
        plain * ((1 - transmission_weight) * luminance(base_color) + 0.5f * transmission_weight);
    const float fuzz = fuzz_weight * Fuzz(fuzz_roughness, {0, 0, cosine}).albedo() * luminance(fuzz_color);
    proxy.diffuse += above.diffuse + kInvPi * (diffuse + fuzz + 1e-3f);
    // One peak has to do.
    if (above.lobe_albedo() > proxy.lobe_albedo()) proxy.peak = above.peak, proxy.sharpness = above.sharpness;
    return proxy;
  }
  Spectrum albedo() const {
    const float opaque = 1 - (1 - base_metalness) * transmission_weight;
    return opaque * base_color + (1 - opaque) * transmission_color;
  }
};

} // namespace candela
