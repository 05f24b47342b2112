#pragma once

#include "bsdf/dielectric.h"
#include "bsdf/facet_albedo.h"

namespace candela {

/// Rough interface between two dielectrics: facets that reflect by the Fresnel equations and refract the rest
/// (Walter et al. 2007, eqs. 20 and 21), chosen by visible normals and by their reflectance. Above means the
/// shading normal's side, the outside.
struct RoughDielectric {
  float ior = 1.5f;          ///< refractive index inside over outside
  Spectrum transmittance{1}; ///< tint of each crossing
  Microfacets facets;
  bool smooth = false; ///< facets are not asked
  /// Gives back light that is scattered more than once between facets; null: it is lost.
  const InterfaceAlbedo* compensation = nullptr;

  /// Facets of nearly the same index on both sides refract by less than floats resolve.
  static bool is_invisible(float ior) { return std::abs(ior - 1) < 1e-3f; }
  /// The same where `ior` is that of the inside over vacuum, and the outside has this one.
  RoughDielectric with_outside_ior(float outside) const {
    RoughDielectric relative = *this;
    relative.ior = ior / outside;
    relative.smooth |= is_invisible(relative.ior);
    return relative;
  }

  Spectrum eval(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    return eval_pdf(wo, wi, mode).f_cos;
  }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    if (smooth || wo.z == 0 || wi.z == 0) return {Spectrum(0), 0};
    const float eta = wo.z > 0 ? ior : 1 / ior;
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z; // the facets of both sides are alike
    if (wi.z > 0) return reflected(wo, wi, glm::normalize(wo + wi), eta);
    // The facet that refracts one into the other; on wo's side.
    vec3 h = wo + eta * wi;
    const float length = glm::length(h);
    if (!(length > 0)) return {Spectrum(0), 0};
    h = h * ((eta > 1 ? -1 : 1) / length);
    return refracted(wo, wi, h, eta, mode);
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) const {
    if (smooth) return flat().sample(wo, u, mode);
    if (wo.z == 0) return std::nullopt;
    const float eta = wo.z > 0 ? ior : 1 / ior;
    const vec3 w = to_side_of({0, 0, 1}, wo), h = facets.sample_visible_normal(w, u.disc);
    const float reflectance = fresnel_dielectric(glm::dot(w, h), eta);
    if (u.lobe < reflectance) {
      const vec3 wi = 2 * glm::dot(w, h) * h - w;
      if (!(wi.z > 0)) return std::nullopt;
      return made(to_side_of(wo, wi), reflected(w, wi, h, eta), 1);
    }
    const vec3 wi = refract_about(w, h, eta);
    if (!(wi.z < 0)) return std::nullopt;
    return made(to_side_of(-wo, wi), refracted(w, wi, h, eta, mode), eta);
  }

  float delta_probability(vec3) const { return smooth ? 1 : 0; }
  BsdfFlags flags() const {
    return BsdfFlags::reflection | BsdfFlags::transmission | (smooth ? BsdfFlags::delta : BsdfFlags::glossy);
  }
  /// What is refracted goes almost anywhere on the other side.
  LobeProxy lobe_proxy(vec3 wo) const {
    if (smooth) return {};
    LobeProxy proxy =
        facet_lobe_proxy(facets, wo, fresnel_dielectric(std::abs(wo.z), wo.z > 0 ? ior : 1 / ior));
    proxy.diffuse = 0.5f * kInvPi;
    return proxy;
  }
  Spectrum albedo() const { return flat().albedo(); }

private:
  Dielectric flat() const { return {ior, transmittance}; }
  float gain(vec3 wo, float eta) const {
    return compensation != nullptr ? 1 / (*compensation)(facets, wo, eta) : 1;
  }

  // wo above the surface, whichever side that is.

  BsdfEval reflected(vec3 wo, vec3 wi, vec3 h, float eta) const {
    const float reflectance = fresnel_dielectric(glm::dot(wo, h), eta), d = facets.d(h);
    const float density = reflectance * d / (4 * wo.z);
    return {Spectrum(density * facets.g2_reflection(wo, wi) * gain(wo, eta)), density * facets.g1(wo)};
  }

  BsdfEval refracted(vec3 wo, vec3 wi, vec3 h, float eta, TransportMode mode) const {
    const float cos_o = glm::dot(wo, h), cos_i = glm::dot(wi, h);
    if (!(h.z > 0 && cos_o > 0 && cos_i < 0)) return {Spectrum(0), 0};
    const float passes = fresnel_dielectric_transmittance(cos_o, -cos_i, eta);
    // Solid angle of normals by that of wi (Walter et al., eq. 17).
    const float jacobian = sqr(eta) * -cos_i / sqr(cos_o + eta * cos_i);
    const float density = passes * facets.d(h) * cos_o * jacobian / wo.z;
    // Radiance over the squared refractive index is what a refraction preserves (Veach 1997, section 5.2).
    const float squeeze = mode == TransportMode::radiance ? 1 / sqr(eta) : 1;
    return {transmittance * (density * facets.g2_transmission(wo, wi) * squeeze * gain(wo, eta)),
            density * facets.g1(wo)};
  }

  /// Masking may leave almost nothing of the light, but the density does not know that.
  std::optional<BsdfSample> made(vec3 wi, BsdfEval e, float eta) const {
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false, eta};
  }
};

} // namespace candela
