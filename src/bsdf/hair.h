#pragma once

#include "bsdf/hair_lobes.h"

namespace candela {

/// A hair or a fibre of fur, a dielectric cylinder with tilted scales and a body that absorbs: Chiang,
/// Bitterli, Tappan & Burley 2016, "A Practical and Controllable Hair and Fur Model for Production Path
/// Tracing". +x is the fibre's direction, from root to tip. Light is scattered along four paths p: reflected
/// (0), through the fibre (1), after one reflection inside (2), and after more (3, evenly around the fibre),
///     f |cos theta_i| = sum over p of A_p M_p N_p,
/// A_p the attenuation, M_p the density of the longitudinal angle, N_p that of the azimuth. Near field: it is
/// of one offset h across the fibre, not the mean over its width.
///
/// It scatters over the whole sphere, whichever way +z points. Without absorption it loses nothing, for every
/// h. It is not reciprocal: attenuation and tilt are of wo's longitudinal angle, as the paper has them.
struct Hair {
  Spectrum sigma_a{0.25f};    ///< absorption coefficient of the inside, 1/radius of the fibre
  float beta_m = 0.3f;        ///< longitudinal roughness, in [kMinBeta, 1]
  float beta_n = 0.3f;        ///< azimuthal roughness, in [kMinBeta, 1]
  float tilt = radians(2.0f); ///< of the scales, alpha, towards the root; radians
  float ior = 1.55f;          ///< refractive index inside over outside, >= 1
  /// Where wo meets the fibre, as wo sees it: the offset from its axis along cross(wo, +x), in radii. 0 is
  /// the middle, -1 and 1 are the edges. Set by who knows the curve's coordinate; of a surface that has a
  /// cylinder's normals it is offset_on_cylinder(wo).
  float h = 0;

  /// Below this float digits no longer resolve the lobes.
  static constexpr float kMinBeta = 0.02f;

  /// h of a point whose local +z is the normal of the cylinder.
  static float offset_on_cylinder(vec3 wo) {
    const float across = std::sqrt(sqr(wo.y) + sqr(wo.z));
    return across > 0 ? std::clamp(-wo.y / across, -1.0f, 1.0f) : 0;
  }

  /// sigma_a of a concentration of eumelanin (brown, black) and of pheomelanin (red), with the coefficients
  /// of d'Eon, Francois, Hill, Letteri & Aubry 2011, "An Energy-Conserving Hair Reflectance Model".
  static Spectrum absorption_of_melanin(float eumelanin, float pheomelanin) {
    return eumelanin * Spectrum(0.419f, 0.697f, 1.37f) + pheomelanin * Spectrum(0.187f, 0.4f, 1.05f);
  }
  /// sigma_a of hair that looks that colour, 0..1, where light is scattered many times: Chiang et al.'s fit
  /// to the albedo of a volume of fibres. Black absorbs as 1e-4 does.
  static Spectrum absorption_of_color(Spectrum color, float beta_n) {
    const Spectrum depth = glm::log(glm::clamp(color, Spectrum(1e-4f), Spectrum(1))) / color_exponent(beta_n);
    return depth * depth;
  }

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }
  BsdfEval eval_pdf(vec3 wo, vec3 wi) const { return lobes(wo).eval_pdf(wi); }

  /// A direction takes four random numbers: the path, two for the longitudinal angle, the azimuth. u.lobe
  /// chooses the path and, rescaled to what is left of it, the azimuth. The disc point is the other two: the
  /// square of its radius is uniform, and so is its angle, of which only the cosine is needed.
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    const HairLobes all = lobes(wo);
    const std::optional<vec3> wi = all.sample(u);
    if (!wi) return std::nullopt;
    const BsdfEval e = all.eval_pdf(*wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{*wi, e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::transmission | BsdfFlags::glossy; }
  /// The same from everywhere: an offset h turns the lobes by any angle.
  LobeProxy lobe_proxy(vec3) const { return {0, 0.25f * kInvPi, 0}; }
  /// The colour of many fibres (the inverse of absorption_of_color).
  Spectrum albedo() const { return glm::exp(-glm::sqrt(sigma_a) * color_exponent(beta_n)); }

  HairLobes lobes(vec3 wo) const { return HairLobes(wo, sigma_a, beta_m, beta_n, tilt, ior, h); }

private:
  static float color_exponent(float b) {
    return 5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
  }
};

} // namespace candela
