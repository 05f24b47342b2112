#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/fresnel.h"
#include "core/color.h"

namespace candela {

/// Smooth sheet of a dielectric so thin that light leaves where it came in, such as a window pane. A face
/// reflects the share R; over all reflections between the two faces,
///     R' = R + (1 - R)^2 R (1 + R^2 + R^4 + ...) = 2 R / (1 + R),   T' = 1 - R' = (1 - R) / (1 + R),
/// and what passes goes straight on (Stokes 1862, "On the intensity of the light reflected from or
/// transmitted through a pile of plates"; the thickness varies by more than a wavelength, so that
/// intensities add). Both sides are alike. Both lobes are delta, chosen by the luminance that they carry.
struct ThinDielectric {
  float ior = 1.5f;          ///< refractive index of the sheet over that of both sides
  Spectrum reflectance{1};   ///< tint of what is reflected
  Spectrum transmittance{1}; ///< tint of what passes

  /// R' above, without the tint.
  float sheet_reflectance(float cos_theta) const {
    const float r = fresnel_dielectric(std::abs(cos_theta), ior);
    return 2 * r / (1 + r);
  }

  Spectrum eval(vec3, vec3) const { return Spectrum(0); }
  float pdf(vec3, vec3) const { return 0; }
  BsdfEval eval_pdf(vec3, vec3) const { return {Spectrum(0), 0}; }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    const float share = sheet_reflectance(wo.z);
    const Spectrum reflected = share * reflectance, passed = (1 - share) * transmittance;
    const float total = luminance(reflected) + luminance(passed);
    if (!(total > 0)) return std::nullopt;
    const float p = luminance(reflected) / total;
    if (u.lobe < p) return BsdfSample{reflect_about_normal(wo), reflected / p, p, true};
    return BsdfSample{-wo, passed / (1 - p), 1 - p, true};
  }
  float delta_probability(vec3) const { return 1; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::transmission | BsdfFlags::delta; }
  /// No light sample finds a delta lobe.
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const {
    const float share = sheet_reflectance(1);
    return share * reflectance + (1 - share) * transmittance;
  }
};

} // namespace candela
