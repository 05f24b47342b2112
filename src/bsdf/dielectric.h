#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/fresnel.h"

namespace candela {

/// Smooth interface between two dielectrics, such as glass: reflects by the Fresnel equations and refracts
/// the rest. The shading normal points outside, so wo.z < 0 is inside. Both lobes are delta, chosen by the
/// reflectance.
struct Dielectric {
  float ior = 1.5f;          ///< refractive index inside over outside; 1 is no interface
  Spectrum transmittance{1}; ///< tint of each crossing

  Spectrum eval(vec3, vec3) const { return Spectrum(0); }
  float pdf(vec3, vec3) const { return 0; }
  BsdfEval eval_pdf(vec3, vec3) const { return {Spectrum(0), 0}; }

  /// The same where `ior` is that of the inside over vacuum, and the outside has this one.
  Dielectric with_outside_ior(float outside) const { return {ior / outside, transmittance}; }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) const {
    float eta = wo.z > 0 ? ior : 1 / ior;
    // Without an interface straight on, also where rounding would make grazing light total reflection.
    std::optional<vec3> wi = ior == 1 ? -wo : refract(wo, eta);
    float reflectance = ior == 1 ? 0 : wi ? fresnel_dielectric(std::abs(wo.z), eta) : 1;
    if (u.lobe < reflectance) return BsdfSample{reflect_about_normal(wo), Spectrum(1), reflectance, true};
    if (is_black(transmittance)) return std::nullopt;
    // Radiance over the squared refractive index is what a refraction preserves: a beam that enters the
    // denser side is squeezed into a smaller solid angle (Veach 1997, section 5.2). wi is where the light
    // comes from.
    const Spectrum weight = mode == TransportMode::radiance ? transmittance / sqr(eta) : transmittance;
    return BsdfSample{*wi, weight, 1 - reflectance, true, eta};
  }
  float delta_probability(vec3) const { return 1; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::transmission | BsdfFlags::delta; }
  /// No light sample finds a delta lobe.
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const {
    float f0 = fresnel_dielectric(1, ior);
    return Spectrum(f0) + (1 - f0) * transmittance;
  }
};

} // namespace candela
