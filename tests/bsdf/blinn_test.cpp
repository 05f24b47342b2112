// Blinn's lobe about the half vector, normalised.

#include "bsdf/blinn.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

std::vector<TestedBsdf> models() {
  std::vector<TestedBsdf> all;
  for (const float n : {0.0f, 1.0f, 40.0f, 1000.0f, 1e6f}) {
    const double width = std::min(2.0, 4 / std::sqrt(double(n) + 1));
    all.push_back(tested(fmt::format("lobe {}", n), Blinn{Spectrum(0), Spectrum(1), n}, width));
    all.push_back(tested(fmt::format("both {}", n),
                         Blinn{Spectrum(0.5f, 0.1f, 0.3f), Spectrum(0.2f, 0.9f, 0.4f), n}, width));
  }
  return all;
}

vec3 polar(double theta, double phi) {
  return {float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)),
          float(std::cos(theta))};
}

TEST(Blinn, SamplesAgree) {
  for (const TestedBsdf& model : models()) expect_samples_agree(model);
}

TEST(Blinn, Reciprocity) {
  for (const TestedBsdf& model : models()) expect_reciprocal(model);
}

TEST(Blinn, IsThatOfTheTextbookInAngles) {
  std::mt19937_64 random(fresh_seed());
  std::uniform_real_distribution<double> uniform(0, 1);
  const double pi = std::numbers::pi;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(seed_note());
    const double to = uniform(random) * 1.55, ti = uniform(random) * 1.55, phi = uniform(random) * 2 * pi,
                 n = 300 * uniform(random);
    // cos(theta_h) = (cos_o + cos_i) / |wo + wi|.
    const double cosine = std::cos(to) * std::cos(ti) + std::sin(to) * std::sin(ti) * std::cos(phi);
    const double cos_h = (std::cos(to) + std::cos(ti)) / std::sqrt(2 + 2 * cosine);
    const double lobe = (n + 2) * (n + 4) / (8 * pi * (n + std::pow(2, -n / 2))) * std::pow(cos_h, n);
    const Blinn blinn{Spectrum(0.25f), Spectrum(0.5f), float(n)};
    const double value = double(blinn.eval(polar(to, 1), polar(ti, 1 + phi)).x) / std::cos(ti);
    EXPECT_NEAR(value, 0.25 / pi + 0.5 * lobe, 1e-5 + 1e-4 * lobe);
  }
}

TEST(Blinn, ReflectsWhatItSaysAlongTheNormal) {
  for (const float n : {0.0f, 1.0f, 10.0f, 200.0f, 5000.0f}) {
    const Blinn blinn{Spectrum(0), Spectrum(0.7f), n};
    const double width = std::min(2.0, 4 / std::sqrt(double(n) + 1));
    EXPECT_NEAR(albedo_by_quadrature(tested("blinn", blinn, width), {0, 0, 1}).x, 0.7, 1e-3) << n;
    // And less from elsewhere.
    float last = 0.701f;
    for (const double theta : {0.3, 0.8, 1.2, 1.5}) {
      const float albedo = albedo_by_quadrature(tested("blinn", blinn, width), polar(theta, 2)).x;
      EXPECT_LE(albedo, last + 1e-3f) << n << ' ' << theta;
      last = albedo;
    }
  }
}

TEST(Blinn, LobeOfExponentZeroIsLambertian) {
  const Blinn blinn{Spectrum(0), Spectrum(1), 0};
  EXPECT_NEAR(blinn.eval(polar(1, 0), polar(0.5, 2)).x, std::cos(0.5) / std::numbers::pi, 1e-6);
}

TEST(BlinnStatistical, DirectionsFollowThePdf) {
  const auto all = models();
  const auto directions = contract_directions();
  for (const TestedBsdf& model : all)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(all.size() * directions.size()), 30000);
}

TEST(BlinnStatistical, EnergyIsConserved) {
  const auto all = models();
  for (const TestedBsdf& model : all) expect_conserves_energy(model, static_cast<int>(all.size()));
}

} // namespace
} // namespace candela::test
