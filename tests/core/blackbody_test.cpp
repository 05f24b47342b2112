// Colours of black bodies against published chromaticities.

#include "core/blackbody.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

glm::dvec2 chromaticity(glm::dvec3 xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

/// The Planckian locus by the cubic splines of Kim et al. 2002 (US patent 7024034), 1667 K to 25000 K.
glm::dvec2 locus(double t) {
  const double x = t <= 4000
                       ? -0.2661239e9 / (t * t * t) - 0.2343589e6 / (t * t) + 0.8776956e3 / t + 0.179910
                       : -3.0258469e9 / (t * t * t) + 2.1070379e6 / (t * t) + 0.2226347e3 / t + 0.240390;
  double y = 0;
  if (t <= 2222)
    y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
  else if (t <= 4000)
    y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
  else
    y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  return {x, y};
}

TEST(ColorMatching, HasTheAreaAndThePeakOfTheStandardObserver) {
  glm::dvec3 area(0);
  double peak = 0;
  for (int nm = 360; nm <= 830; ++nm) {
    area += color_matching(nm);
    peak = std::max(peak, color_matching(nm).y);
  }
  // CIE 15: the three areas are equal, 106.857, and the luminosity is 1 at its peak of 555 nm.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(area[c], 106.857, 0.6) << c;
  EXPECT_NEAR(peak, 1, 0.012);
  EXPECT_NEAR(color_matching(555).y, 1, 0.012);
}

TEST(ColorMatching, WhiteIsD65) {
  const glm::dvec3 d65(0.95047, 1, 1.08883);
  const glm::dvec3 rgb = rec709_from_xyz(d65);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1, 2e-4) << c;
  const glm::dvec3 odd(0.3, 0.7, 0.1);
  EXPECT_NEAR(luminance(vec3(rec709_from_xyz(odd))), 0.7, 1e-5);
}

TEST(Blackbody, SpectrumObeysStefanBoltzmannAndWien) {
  for (double kelvin : {1000.0, 2856.0, 6504.0, 20000.0}) {
    double sum = 0, peak = 0, peak_nm = 0;
    // By the logarithm of the wavelength: d lambda = lambda d(log lambda).
    const double step = 1e-3;
    for (double log_nm = std::log(10.0); log_nm < std::log(1e6); log_nm += step) {
      const double nm = std::exp(log_nm), radiance = planck_radiance(nm, kelvin);
      sum += radiance * nm * step;
      if (radiance > peak) peak = radiance, peak_nm = nm;
    }
    EXPECT_NEAR(std::numbers::pi * sum / (5.670374419e-8 * std::pow(kelvin, 4)), 1, 1e-4) << kelvin;
    EXPECT_NEAR(peak_nm * kelvin, 2.897771955e6, 4e3) << kelvin;
  }
}

TEST(Blackbody, HasPublishedChromaticities) {
  // Illuminant A (CIE 15) and the Planckian locus (Wyszecki and Stiles 1982).
  struct Case {
    double kelvin, x, y;
  };
  for (const Case& c : {Case{2856, 0.44757, 0.40745}, {6504, 0.3135, 0.3236}, {10000, 0.2807, 0.2884}}) {
    const glm::dvec2 xy = chromaticity(blackbody_xyz(c.kelvin));
    EXPECT_NEAR(xy.x, c.x, 2e-3) << c.kelvin;
    EXPECT_NEAR(xy.y, c.y, 2e-3) << c.kelvin;
  }
  // The fits of the observer are least good in the far red.
  for (double kelvin = 1700; kelvin < 25000; kelvin *= 1.1)
    EXPECT_LT(glm::length(chromaticity(blackbody_xyz(kelvin)) - locus(kelvin)), kelvin < 2500 ? 5e-3 : 2.5e-3)
        << kelvin;
}

TEST(Blackbody, SumOfThePlanckianSpectrumIsThatOfItsColor) {
  // The scaled sum against a plain one.
  for (double kelvin : {2000.0, 6504.0, 30000.0}) {
    glm::dvec3 sum(0);
    for (int nm = 360; nm <= 830; ++nm) sum += planck_radiance(nm, kelvin) * color_matching(nm);
    EXPECT_LT(glm::length(sum / sum.y - blackbody_xyz(kelvin)), 1e-3) << kelvin;
  }
}

TEST(Blackbody, ColorsHaveLuminanceOneAndGrowBluer) {
  float last = -1;
  for (float kelvin = 500; kelvin < 60000; kelvin *= 1.1f) {
    const vec3 rgb = blackbody_color(kelvin);
    ASSERT_TRUE(is_finite(rgb)) << kelvin;
    EXPECT_GE(min_component(rgb), 0) << kelvin;
    EXPECT_NEAR(luminance(rgb), 1, 1e-6) << kelvin;
    const float blueness = rgb.z / rgb.x;
    EXPECT_GE(blueness, last) << kelvin;
    last = blueness;
  }
  // Warm is red, 6504 K is nearly the white of the display.
  EXPECT_GT(blackbody_color(2000).x, 4 * blackbody_color(2000).z);
  EXPECT_LT(glm::length(blackbody_color(6504) - vec3(1)), 0.1f);
  for (float bad : {NAN, -INFINITY, INFINITY, -1.0f, 0.0f})
    EXPECT_TRUE(is_finite(blackbody_color(bad))) << bad;
  EXPECT_EQ(blackbody_color(1), blackbody_color(800));
}

} // namespace
} // namespace candela
