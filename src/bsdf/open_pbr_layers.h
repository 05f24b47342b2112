#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/facet_albedo.h"
#include "bsdf/open_pbr_values.h"

namespace candela {

/// An OpenPBR surface as light from one direction sees it ("Reduction to a mixture of lobes"):
///     fuzz + (1 - E_fuzz) (coat + (1 - E_coat) T_coat darkening base),
/// E the share that a layer reflects of the light from wo. The base is a mixture by area of metal, of glass,
/// and of diffuse reflection below a dielectric, whose facets are the same.
///
/// From outside all of it is there. Inside, the share of glass shows its interface alone, and lets out what
/// the layers on it let in along the same way; the rest is opaque and looks as from outside.
class OpenPbrLayers {
public:
  OpenPbrLayers(const OpenPbrValues& v, vec3 wo, TransportMode mode)
      : v_(v), mode_(mode), wo_(to_side_of({0, 0, 1}, wo)), side_(wo), inside_(wo.z < 0), fresnel_(v),
        glass_ior_(std::max(fresnel_.eta_of_base(), kMinRefractingIndex)),
        eta_(inside_ ? 1 / glass_ior_ : glass_ior_), metal_(v.base_metalness),
        glass_((1 - metal_) * v.transmission_weight), matte_((1 - metal_) * (1 - v.transmission_weight)),
        layers_(inside_ ? 1 - glass_ : 1),
        base_(open_pbr::facets(open_pbr::base_roughness(v), v.specular_roughness_anisotropy)),
        coat_(open_pbr::facets(v.coat_roughness, v.coat_roughness_anisotropy)),
        fuzz_(v.fuzz_roughness, wo_), diffuse_{v.base_color, v.base_diffuse_roughness} {
    if (wo_.z == 0) return;
    const float cosine = wo_.z;
    below_fuzz_ = 1 - v.fuzz_weight * fuzz_.albedo();
    if (v.coat_weight > 0) coat_albedo_ = layer_albedo(coat_, wo_, v.coat_ior);
    darkening_ = open_pbr::darkening(v, cosine);
    if (metal_ > 0) metal_gain_ = multiple_scattering_gain(lossless_share(base_, wo_), fresnel_.metal(1));
    if (glass_ > 0) glass_gain_ = glass_gain();
    if (matte_ > 0 && !is_black(v.base_color)) below_gloss_ = below_gloss();

    const Split split = split_at(cosine);
    const Spectrum reaches = darkening_ * through_coat(cosine, cosine);
    const float interface = luminance(reaches * split.reflected + split.from_within) +
                            luminance(through_coat_once(cosine) * split.refracted);
    p_fuzz_ = layers_ * v.fuzz_weight * fuzz_.albedo() * luminance(v.fuzz_color);
    p_coat_ = v.coat_weight > 0 ? layers_ * below_fuzz_ * v.coat_weight * std::max(coat_albedo_, 0.005f) : 0;
    p_diffuse_ = below_fuzz_ * matte_ * luminance(reaches * below_gloss_ * v.base_color);
    p_interface_ = std::max(below_fuzz_ * interface, 0.005f); // it may be more at other facets
    const float sum = p_fuzz_ + p_coat_ + p_diffuse_ + p_interface_;
    for (float* p : {&p_fuzz_, &p_coat_, &p_diffuse_, &p_interface_}) *p /= sum;
  }

  BsdfEval eval_pdf(vec3 wi) const {
    if (wo_.z == 0 || wi.z == 0) return {Spectrum(0), 0};
    if (inside_) wi.z = -wi.z;
    if (wi.z > 0) return reflected(wi);
    if (!(glass_ > 0)) return {Spectrum(0), 0};
    const vec3 h = wo_ + eta_ * wi;
    const float length = glm::length(h);
    if (!(length > 0)) return {Spectrum(0), 0};
    return refracted(wi, h * ((eta_ > 1 ? -1 : 1) / length));
  }

  std::optional<BsdfSample> sample(BsdfU u) const {
    if (wo_.z == 0) return std::nullopt;
    float v = u.lobe;
    if (v < p_fuzz_) return made(fuzz_.sample(u.disc));
    v -= p_fuzz_;
    if (v < p_coat_) return made(mirrored(coat_.sample_reflecting_normal(wo_, u.disc)));
    v -= p_coat_;
    if (v < p_diffuse_) {
      const float rest = std::min(v / p_diffuse_, kOneMinusEpsilon);
      const auto s = diffuse_.sample(wo_, BsdfU(u.disc, rest));
      return s ? made(s->wi) : std::nullopt;
    }
    if (!(glass_ > 0)) return made(mirrored(base_.sample_reflecting_normal(wo_, u.disc)));
    const vec3 h = base_.sample_visible_normal(wo_, u.disc);
    if ((v - p_diffuse_) / p_interface_ < split_at(glm::dot(wo_, h)).reflecting_share())
      return made(mirrored(h));
    const vec3 wi = refract_about(wo_, h, eta_);
    if (!(wi.z < 0)) return std::nullopt;
    const BsdfEval e = refracted(wi, h);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(-side_, wi), e.f_cos / e.pdf, e.pdf, false, eta_};
  }

private:
  /// What refracts must bend a little, or the half vector is lost.
  static constexpr float kMinRefractingIndex = 1.02f;

  /// What the base's facets do that see light at that cosine.
  struct Split {
    Spectrum reflected;   ///< below the layers
    Spectrum from_within; ///< by glass, from inside: the layers are beyond it
    Spectrum refracted;
    /// Of them, how many are sampled to reflect.
    float reflecting_share() const {
      const float r = luminance(reflected + from_within), t = luminance(refracted);
      return t > 0 ? r / (r + t) : 1;
    }
  };
  Split split_at(float cosine) const {
    if (!(glass_ > 0)) return {opaque(cosine), Spectrum(0), Spectrum(0)};
    const float cos2 = 1 - (1 - sqr(cosine)) / sqr(eta_);
    return split_at(cosine, cos2 > 0 ? std::sqrt(cos2) : 0);
  }
  Split split_at(float cosine, float cosine_refracted) const {
    // Plain, then with the film, which from inside is the same by reciprocity where anything passes. What
    // glass scatters more than once is given back to the plain part: how a film shares it is not known.
    const bool refracts = cosine_refracted > 0;
    const float passes = refracts ? fresnel_dielectric_transmittance(cosine, cosine_refracted, eta_) : 0;
    Spectrum mirrors(glass_gain_ * fresnel_dielectric(cosine, eta_)), lets(glass_gain_ * passes);
    if (fresnel_.has_film()) {
      const Spectrum film =
          refracts ? fresnel_.film(inside_ ? cosine_refracted : cosine, glass_ior_) : Spectrum(1);
      mirrors = open_pbr::lerp(mirrors, film, v_.thin_film_weight);
      lets = open_pbr::lerp(lets, Spectrum(1) - film, v_.thin_film_weight);
    }
    Split split{opaque(cosine), Spectrum(0), glass_ * lets * v_.transmission_color};
    if (inside_)
      split.from_within = glass_ * mirrors;
    else
      split.reflected += glass_ * mirrors * v_.specular_color;
    return split;
  }
  Spectrum opaque(float cosine) const {
    Spectrum sum(0);
    if (metal_ > 0) sum += metal_ * metal_gain_ * fresnel_.metal(cosine);
    if (matte_ > 0) sum += matte_ * v_.specular_color * fresnel_.dielectric(cosine);
    return sum;
  }

  /// What dielectric facets leave for the diffuse reflection below them. The tint of their reflection is no
  /// matter to it.
  Spectrum below_gloss() const {
    if (!fresnel_.has_film()) return Spectrum(1 - layer_albedo(base_, wo_, fresnel_.eta_of_base()));
    return Spectrum(1) - ReflectedShares::albedo(base_, wo_, [&](float c) { return fresnel_.dielectric(c); });
  }
  /// Gives back what glass scatters more than once, but for anisotropic facets, of which it is not known.
  float glass_gain() const {
    constexpr float kMargin = 1.006f; // of the table's error
    if (base_.alpha_x != base_.alpha_y) return 1;
    const float albedo = InterfaceAlbedo::of(MicrofacetDistribution::ggx)(base_, wo_, eta_);
    return 1 / std::min(kMargin * albedo, 1.0f);
  }

  /// In and out again, and in or out.
  Spectrum through_coat(float cos_o, float cos_i) const {
    const Spectrum coated = (1 - coat_albedo_) * open_pbr::coat_transmittance(v_, cos_o) *
                            open_pbr::coat_transmittance(v_, cos_i);
    return open_pbr::lerp(Spectrum(1), coated, v_.coat_weight);
  }
  Spectrum through_coat_once(float cosine) const {
    return open_pbr::lerp(Spectrum(1), (1 - coat_albedo_) * open_pbr::coat_transmittance(v_, cosine),
                          v_.coat_weight);
  }
  /// The layers' transmittance for what is refracted, along its direction outside.
  Spectrum through_layers(vec3 outside) const {
    if (!inside_) return below_fuzz_ * through_coat_once(outside.z);
    const float albedo = v_.coat_weight > 0 ? layer_albedo(coat_, outside, v_.coat_ior) : 0;
    const float fuzz = v_.fuzz_weight > 0 ? v_.fuzz_weight * Fuzz(v_.fuzz_roughness, outside).albedo() : 0;
    return (1 - fuzz) * open_pbr::lerp(Spectrum(1),
                                       (1 - albedo) * open_pbr::coat_transmittance(v_, outside.z),
                                       v_.coat_weight);
  }

  // In the frame where wo is above; so is wi of what is reflected.

  vec3 mirrored(vec3 h) const { return 2 * glm::dot(wo_, h) * h - wo_; }

  BsdfEval reflected(vec3 wi) const {
    const vec3 h = glm::normalize(wo_ + wi);
    const float cosine = glm::dot(wo_, h);
    const Split split = split_at(cosine);
    const float lobe = base_.d(h) * base_.g2_reflection(wo_, wi) / (4 * wo_.z);
    Spectrum base = split.reflected * lobe;
    float pdf =
        p_interface_ * (glass_ > 0 ? split.reflecting_share() * base_.g1(wo_) * base_.d(h) / (4 * wo_.z)
                                   : base_.reflection_pdf(wo_, h));
    if (p_diffuse_ > 0) {
      base += matte_ * below_gloss_ * diffuse_.eval(wo_, wi);
      pdf += p_diffuse_ * diffuse_.pdf(wo_, wi);
    }
    Spectrum f_cos = darkening_ * through_coat(wo_.z, wi.z) * base;
    if (v_.coat_weight > 0) {
      f_cos += Spectrum(layers_ * v_.coat_weight * fresnel_dielectric(cosine, v_.coat_ior) * coat_.d(h) *
                        coat_.g2_reflection(wo_, wi) / (4 * wo_.z));
      pdf += p_coat_ * coat_.reflection_pdf(wo_, h);
    }
    f_cos = below_fuzz_ * f_cos + split.from_within * lobe;
    if (p_fuzz_ > 0) {
      const float density = fuzz_.pdf(wi);
      f_cos += v_.fuzz_color * (layers_ * v_.fuzz_weight * fuzz_.albedo() * density);
      pdf += p_fuzz_ * density;
    }
    return {f_cos, pdf};
  }

  /// As RoughDielectric does (Walter et al. 2007, eqs. 17 and 21).
  BsdfEval refracted(vec3 wi, vec3 h) const {
    const float cos_o = glm::dot(wo_, h), cos_i = glm::dot(wi, h);
    if (!(h.z > 0 && cos_o > 0 && cos_i < 0)) return {Spectrum(0), 0};
    const Split split = split_at(cos_o, -cos_i);
    const float density = base_.d(h) * cos_o * sqr(eta_) * -cos_i / (sqr(cos_o + eta_ * cos_i) * wo_.z);
    const float squeeze = mode_ == TransportMode::radiance ? 1 / sqr(eta_) : 1;
    const vec3 outside = inside_ ? vec3(wi.x, wi.y, -wi.z) : wo_;
    return {through_layers(outside) * split.refracted * (density * base_.g2_transmission(wo_, wi) * squeeze),
            p_interface_ * (1 - split.reflecting_share()) * density * base_.g1(wo_)};
  }

  std::optional<BsdfSample> made(vec3 wi) const {
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = reflected(wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(side_, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  const OpenPbrValues& v_;
  TransportMode mode_;
  vec3 wo_;   ///< above
  vec3 side_; ///< wo as it was
  bool inside_;
  open_pbr::BaseFresnel fresnel_;
  float glass_ior_;
  float eta_;                   ///< of the far side over wo's
  float metal_, glass_, matte_; ///< shares of the base
  float layers_;                ///< share of coat and fuzz that is to be seen
  Microfacets base_, coat_;
  Fuzz fuzz_;
  OrenNayar diffuse_;
  // Of light from wo.
  float below_fuzz_ = 1, coat_albedo_ = 0, glass_gain_ = 1;
  Spectrum darkening_{1}, metal_gain_{1}, below_gloss_{0};
  float p_fuzz_ = 0, p_coat_ = 0, p_diffuse_ = 0, p_interface_ = 0; ///< probabilities of the lobes
};

} // namespace candela
