// Interference colours, against Airy's formula integrated over the spectrum.

#include "bsdf/f82_tint.h"
#include "bsdf/thin_film.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace candela::test {
namespace {

using Complex = std::complex<double>;

/// Reflectance of a film at one wavelength in nm: amplitudes of both polarisations in complex numbers (Born &
/// Wolf, section 7.6).
double airy(double wavelength, double cosine, double outside, double film, Complex base, double thickness) {
  const auto cosine_in = [&](Complex n) {
    return std::sqrt(1.0 - outside * outside * (1 - cosine * cosine) / (n * n));
  };
  const Complex c1 = cosine, c2 = cosine_in(film), c3 = cosine_in(base);
  const auto s = [](Complex na, Complex ca, Complex nb, Complex cb) {
    return (na * ca - nb * cb) / (na * ca + nb * cb);
  };
  const auto p = [](Complex na, Complex ca, Complex nb, Complex cb) {
    return (nb * ca - na * cb) / (nb * ca + na * cb);
  };
  const Complex turn = std::exp(Complex(0, 1) * (4 * std::numbers::pi * film * thickness / wavelength) * c2);
  const auto both = [&](Complex r12, Complex r23) {
    return std::norm((r12 + r23 * turn) / (1.0 + r12 * r23 * turn));
  };
  return 0.5 * (both(s(outside, c1, film, c2), s(film, c2, base, c3)) +
                both(p(outside, c1, film, c2), p(film, c2, base, c3)));
}

/// CIE 1931 by Wyman, Sloan & Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", the multi-lobe fit.
double lobe(double x, double mean, double below, double above) {
  const double t = (x - mean) / (x < mean ? below : above);
  return std::exp(-0.5 * t * t);
}
/// Linear Rec. 709 under equal energy, white for a constant of 1.
vec3 rgb_of(const std::function<double(double)>& reflectance) {
  double xyz[3] = {}, white[3] = {};
  for (double l = 360; l <= 830; l += 0.5) {
    const double bar[3] = {1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
                               0.065 * lobe(l, 501.1, 20.4, 26.2),
                           0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1),
                           1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8)};
    for (int c = 0; c < 3; ++c) xyz[c] += reflectance(l) * bar[c], white[c] += bar[c];
  }
  constexpr double m[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                              {-0.9692660, 1.8760108, 0.0415560},
                              {0.0556434, -0.2040259, 1.0572252}};
  vec3 rgb;
  for (int c = 0; c < 3; ++c) {
    double sum = 0, norm = 0;
    for (int k = 0; k < 3; ++k) sum += m[c][k] * xyz[k] / white[k], norm += m[c][k];
    rgb[c] = static_cast<float>(std::clamp(sum / norm, 0.0, 1.0));
  }
  return rgb;
}

TEST(ThinFilm, OverDielectricsAsAirysFormula) {
  float worst = 0;
  for (const float base : {1.0f, 1.5f, 2.0f})
    for (const float film : {1.33f, 1.8f})
      for (const float thickness : {50.0f, 150.0f, 300.0f, 500.0f, 900.0f})
        for (const float cosine : {1.0f, 0.7f, 0.3f}) {
          const vec3 exact = rgb_of([&](double l) {
            return airy(l, double(cosine), 1, double(film), double(base), double(thickness));
          });
          const Spectrum fit = ThinFilm{film, thickness, 1}.over_dielectric(cosine, base);
          for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(fit[c] - exact[c]));
            EXPECT_NEAR(fit[c], exact[c], 0.05) << base << ' ' << film << ' ' << thickness << ' ' << cosine;
          }
        }
  fmt::print("worst {}\n", worst);
}

TEST(ThinFilm, OverConductorsAsAirysFormula) {
  float worst = 0;
  for (const auto& [n, k] : {std::pair(0.2f, 3.9f), std::pair(2.9f, 3.1f)})
    for (const float film : {1.4f, 2.0f})
      for (const float thickness : {80.0f, 250.0f, 500.0f})
        for (const float cosine : {1.0f, 0.6f, 0.2f}) {
          const vec3 exact = rgb_of([&, n = n, k = k](double l) {
            return airy(l, double(cosine), 1, double(film), Complex(double(n), double(k)), double(thickness));
          });
          const Spectrum fit = ThinFilm{film, thickness, 1}.over_conductor(cosine, Spectrum(n), Spectrum(k));
          for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(fit[c] - exact[c]));
            EXPECT_NEAR(fit[c], exact[c], 0.06) << n << ' ' << film << ' ' << thickness << ' ' << cosine;
          }
        }
  fmt::print("worst {}\n", worst);
}

TEST(ThinFilm, OfTheOutsidesIndexIsNone) {
  for (float cosine = 0.05f; cosine <= 1; cosine += 0.05f) {
    const ThinFilm film{1, 400, 1};
    EXPECT_NEAR(film.over_dielectric(cosine, 1.5f).x, fresnel_dielectric(cosine, 1.5f), 1e-5);
    const Spectrum gold =
        fresnel_conductor(cosine, Spectrum(0.143f, 0.375f, 1.442f), Spectrum(3.983f, 2.386f, 1.603f));
    const Spectrum seen =
        film.over_conductor(cosine, Spectrum(0.143f, 0.375f, 1.442f), Spectrum(3.983f, 2.386f, 1.603f));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], gold[c], 1e-5);
    const F82Tint metal{{0.9f, 0.6f, 0.3f}, {0.8f, 0.9f, 1.0f}};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(film.over_mirror(cosine, metal)[c], metal(cosine)[c], 1e-5);
  }
}

TEST(ThinFilm, OfTheBasesIndexIsTheBase) {
  // Nothing is reflected between them, whatever the phase.
  for (float cosine = 0.05f; cosine <= 1; cosine += 0.05f)
    for (const float thickness : {0.0f, 300.0f})
      EXPECT_NEAR((ThinFilm{1.5f, thickness, 1}.over_dielectric(cosine, 1.5f).y),
                  fresnel_dielectric(cosine, 1.5f), 1e-5);
}

TEST(ThinFilm, GrazingDirectionsAreMirrored) {
  // Over a base of the outside's index, and of the film's denser and thinner ones, down to no cosine at all.
  for (const float base : {1.0f, 1.2f, 1.5f, 2.4f})
    for (const float cosine : {0.0f, 1e-30f, 1e-12f, 1e-9f, 3e-8f, 1e-6f}) {
      const ThinFilm film{2.45f, 500, 1};
      for (const Spectrum mirrored :
           {film.over_dielectric(cosine, base), film.over_conductor(cosine, Spectrum(base), Spectrum(3)),
            film.over_mirror(cosine, [](float) { return Spectrum(1); })})
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mirrored[c], 1, 1e-4) << base << ' ' << cosine;
    }
}

TEST(F82Tint, ItsTwoColours) {
  const F82Tint metal{{0.9f, 0.6f, 0.3f}, {0.8f, 0.5f, 1.0f}};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(metal(1)[c], metal.f0[c], 1e-6);
    EXPECT_NEAR(metal(1.0f / 7)[c], metal.tint[c] * fresnel_schlick(metal.f0, 1.0f / 7)[c], 1e-6);
    EXPECT_NEAR(metal(0)[c], 1, 1e-6);
  }
  for (float cosine = 0; cosine <= 1; cosine += 0.02f)
    EXPECT_NEAR((F82Tint{{0.9f, 0.6f, 0.3f}, Spectrum(1)}(cosine).y),
                fresnel_schlick({0.9f, 0.6f, 0.3f}, cosine).y, 1e-6);
}

} // namespace
} // namespace candela::test
