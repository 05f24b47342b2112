#pragma once
// Colours of a film so thin that what its two sides reflect interferes:
//   Belcour & Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying
//   Iridescence".

#include "core/color.h"
#include "core/spectrum.h"

#include <complex>

namespace candela {

/// Indices of refraction are absolute. Reflectances are as under an illuminant of equal energy.
struct ThinFilm {
  float ior = 1.4f;
  float thickness = 500; ///< nm
  float outside = 1;     ///< index of the medium that light comes from

  /// Over a dielectric of the index `base`.
  Spectrum over_dielectric(float cosine, float base) const {
    const float cos_film = cosine_below(cosine, outside, ior);
    if (!(cos_film > 0)) return Spectrum(1);
    const float cos_base = cosine_below(cos_film, ior, base);
    Spectrum sum(0);
    for (const bool parallel : {false, true}) {
      // Where the base reflects totally, the shift of phase that goes with it is left out.
      const float r23 = cos_base > 0 ? amplitude(cos_film, cos_base, ior, base, parallel) : 1;
      sum += airy(amplitude(cosine, cos_film, outside, ior, parallel), Spectrum(sqr(r23)),
                  Spectrum(r23 < 0 ? kPi : 0), cos_film);
    }
    return clamped(sum);
  }

  /// Over a metal of the index eta + i k.
  Spectrum over_conductor(float cosine, Spectrum eta, Spectrum k) const {
    const float cos_film = cosine_below(cosine, outside, ior);
    if (!(cos_film > 0)) return Spectrum(1);
    Spectrum sum(0);
    for (const bool parallel : {false, true}) {
      Spectrum reflectance, phase;
      for (int c = 0; c < 3; ++c) {
        const std::complex<float> n(eta[c], k[c]), ratio = ior / n;
        const std::complex<float> cos_base = std::sqrt(1.0f - ratio * ratio * (1 - sqr(cos_film)));
        const std::complex<float> a = parallel ? n * cos_film : ior * cos_film,
                                  b = parallel ? ior * cos_base : n * cos_base;
        const std::complex<float> r23 = (a - b) / (a + b);
        reflectance[c] = std::norm(r23);
        phase[c] = std::arg(r23);
      }
      sum += airy(amplitude(cosine, cos_film, outside, ior, parallel), reflectance, phase, cos_film);
    }
    return clamped(sum);
  }

  /// Over what mirrors reflectance(cosine within the film) and is dense, so that both polarisations turn
  /// round. A film of the outside's index changes nothing.
  template <class Reflectance>
  Spectrum over_mirror(float cosine, Reflectance reflectance) const {
    const float cos_film = cosine_below(cosine, outside, ior);
    if (!(cos_film > 0)) return Spectrum(1);
    const Spectrum base = reflectance(cos_film);
    Spectrum sum(0);
    for (const bool parallel : {false, true})
      sum += airy(amplitude(cosine, cos_film, outside, ior, parallel), base, Spectrum(parallel ? 0 : kPi),
                  cos_film);
    return clamped(sum);
  }

private:
  /// Snell's law; 0 under total internal reflection.
  static float cosine_below(float cosine, float above, float below) {
    return safe_sqrt(1 - sqr(above / below) * (1 - sqr(cosine)));
  }
  /// Fresnel's amplitude of reflection, with the sign that makes both polarisations of one sign where the
  /// field turns round at normal incidence into the denser medium and the parallel one is measured along its
  /// own direction.
  static float amplitude(float cos_above, float cos_below, float above, float below, bool parallel) {
    return parallel ? (below * cos_above - above * cos_below) / (below * cos_above + above * cos_below)
                    : (above * cos_above - below * cos_below) / (above * cos_above + below * cos_below);
  }

  /// The sum of all that is reflected between the film's sides (eqs. 7 to 10): of the order m a cosine of
  /// m times the phase, which the width of the CIE curves damps. Orders above 3 are taken for grey.
  Spectrum airy(float r12, Spectrum r23_squared, Spectrum phase23, float cos_film) const {
    const float r12_squared = sqr(r12), passes = 1 - r12_squared;
    // Where both sides mirror all of it, in grazing directions, nothing gets within: 0 / 0 in floats.
    const Spectrum escapes = glm::max(Spectrum(1) - r12_squared * r23_squared, Spectrum(1e-8f));
    const Spectrum within = passes * passes * r23_squared / escapes;
    const Spectrum round_trip = glm::sqrt(r12_squared * r23_squared);
    const Spectrum phase = phase23 + (r12 > 0 ? kPi : 0); // r21 = -r12
    const float path = 2 * ior * thickness * cos_film;
    Spectrum order = within - passes, xyz(0), grey = r12_squared + within;
    for (int m = 1; m <= 3; ++m) {
      order *= round_trip;
      xyz += 2.0f * order * sensitivity(static_cast<float>(m) * path, static_cast<float>(m) * phase);
    }
    return grey + rgb_from_xyz(xyz);
  }

  /// Fourier transform of the CIE 1931 curves in the wave number, at an optical path in nm, shifted in phase:
  /// the authors' fit by Gaussians (their supplemental code), in 1/nm and nm^-2.
  static Spectrum sensitivity(float path, Spectrum phase) {
    constexpr float kNorm = 1.0685e-7f;
    const float x = 2 * kPi * path;
    const auto lobe = [&](float value, float position, float variance, float shift) {
      // The fit's units are metres: value, and 1e-9 of the position, 1e-18 of the variance.
      return value / kNorm * std::sqrt(2 * kPi * variance) * std::cos(position * 1e-9f * x + shift) *
             std::exp(-variance * 1e-18f * sqr(x));
    };
    return {
        lobe(5.4856e-13f, 1.6810e6f, 4.3278e9f, phase.x) + lobe(9.7470e-14f, 2.2399e6f, 4.5282e9f, phase.x),
        lobe(4.4201e-13f, 1.7953e6f, 9.3046e9f, phase.y), lobe(5.2481e-13f, 2.2084e6f, 6.6121e9f, phase.z)};
  }

  /// Rec. 709, its rows scaled so that a constant reflectance is white under an illuminant of equal energy.
  static Spectrum rgb_from_xyz(Spectrum xyz) {
    constexpr float m[3][3] = {{3.2404542f, -1.5371385f, -0.4985314f},
                               {-0.9692660f, 1.8760108f, 0.0415560f},
                               {0.0556434f, -0.2040259f, 1.0572252f}};
    Spectrum rgb;
    for (int c = 0; c < 3; ++c)
      rgb[c] = (m[c][0] * xyz.x + m[c][1] * xyz.y + m[c][2] * xyz.z) / (m[c][0] + m[c][1] + m[c][2]);
    return rgb;
  }
  /// Of both polarisations. Colours that Rec. 709 does not hold are cut off.
  static Spectrum clamped(Spectrum sum) { return glm::clamp(0.5f * sum, 0.0f, 1.0f); }
};

} // namespace candela
