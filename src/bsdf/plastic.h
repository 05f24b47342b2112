#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/coat_albedo.h"
#include "bsdf/fresnel.h"
#include "core/color.h"

namespace candela {

/// A diffuse base under a clear dielectric coat, smooth or rough. The coat reflects by the Fresnel equations;
/// what it lets pass is scattered by the base, again each time that the coat throws it back from inside:
///     f = specular f_coat + rho T(wo) T(wi) / (pi n^2 (1 - R_in rho')),
/// with T = 1 - the coat's reflectance, and R_in that of diffuse light from inside. rho' is rho where the
/// colour of what is scattered more than once is wanted (nonlinear, saturated), else 1, so that rho is the
/// share of what enters that leaves. Of Wolff, Nayar & Oren 1998, "Improved Diffuse Reflection Models for
/// Computer Vision", and of Mitsuba's plastic and roughplastic. Nothing is lost where all are 1, for
/// n^2 (1 - R_in) = the mean of T; of a rough coat that is as true as its table, to some 1e-3. Reciprocal.
struct Plastic {
  Spectrum diffuse{0.5f}; ///< rho, of the base
  Spectrum specular{1};   ///< factor of the coat's reflection, 1 for a real coat
  float ior = 1.5f;       ///< of the coat over that of the outside, from 1 to CoatAlbedo::kMaxEta
  bool nonlinear = false;
  Microfacets facets = {};           ///< round ones
  const CoatAlbedo* rough = nullptr; ///< null: the coat is smooth, and facets are not asked
  float mean_transmittance = mean_of(ior, facets, rough); ///< T of diffuse light

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    return above(wo, wi, reflectance(wo.z));
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    const vec3 w = to_side_of({0, 0, 1}, wo);
    const float reflected = reflectance(w.z), p = specular_probability(reflected);
    vec3 wi;
    if (u.lobe < p) {
      if (rough == nullptr) return BsdfSample{reflect_about_normal(wo), specular * (reflected / p), p, true};
      const vec3 h = facets.sample_reflecting_normal(w, u.disc);
      wi = 2 * glm::dot(w, h) * h - w;
    } else {
      wi = cosine_hemisphere_from_disc(u.disc);
    }
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = above(w, wi, reflected);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(wo, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3 wo) const {
    return rough == nullptr ? specular_probability(reflectance(std::abs(wo.z))) : 0;
  }
  BsdfFlags flags() const {
    return BsdfFlags::reflection | BsdfFlags::diffuse |
           (rough == nullptr ? BsdfFlags::delta : BsdfFlags::glossy);
  }
  LobeProxy lobe_proxy(vec3 wo) const {
    LobeProxy proxy;
    if (rough != nullptr)
      proxy = facet_lobe_proxy(facets, wo, luminance(specular) * reflectance(std::abs(wo.z)));
    proxy.diffuse = luminance(base_albedo()) * kInvPi;
    // Of whatever colour, it reflects.
    if (!(proxy.diffuse > 0)) proxy.diffuse = 1e-3f;
    return proxy;
  }
  Spectrum albedo() const { return base_albedo() * mean_transmittance + specular * (1 - mean_transmittance); }

  /// Share that leaves of the light that enters the coat.
  Spectrum base_albedo() const {
    // n^2 (1 - R_in rho') = n^2 - rho' (n^2 - mean of T).
    if (!nonlinear) return diffuse;
    return diffuse * mean_transmittance / (Spectrum(sqr(ior)) - diffuse * (sqr(ior) - mean_transmittance));
  }

  static float mean_of(float ior, const Microfacets& facets, const CoatAlbedo* rough) {
    return 1 - (rough != nullptr ? rough->mean(facets.alpha_x, ior) : diffuse_fresnel_reflectance(ior));
  }

  /// Of the coat, for light from that angle.
  float reflectance(float cosine) const {
    return rough != nullptr ? (*rough)(facets.alpha_x, cosine, ior) : fresnel_dielectric(cosine, ior);
  }
  /// By what each lobe reflects, in luminance.
  float specular_probability(float reflected) const {
    const float coat = luminance(specular) * reflected;
    const float base = luminance(base_albedo()) * (1 - reflected);
    return coat > 0 ? coat / (coat + base) : 0;
  }

private:
  BsdfEval above(vec3 wo, vec3 wi, float reflected_o) const {
    const float p = specular_probability(reflected_o), cosine_pdf = wi.z * kInvPi;
    const float passes = (1 - reflected_o) * (1 - reflectance(wi.z)) / mean_transmittance;
    BsdfEval e{base_albedo() * (passes * cosine_pdf), (1 - p) * cosine_pdf};
    if (rough != nullptr) {
      // The half vector's cosine to both is half the sum's length: the same from both sides.
      const vec3 sum = wo + wi;
      const float length = glm::length(sum);
      const vec3 h = sum / length;
      const float f = fresnel_dielectric(std::min(0.5f * length, 1.0f), ior);
      e.f_cos += specular * (f * facets.d(h) * facets.g2_reflection(wo, wi) / (4 * wo.z));
      e.pdf += p * facets.reflection_pdf(wo, h);
    }
    return e;
  }
};

} // namespace candela
