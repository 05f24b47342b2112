// Rough matte surfaces: Oren & Nayar's model, Fujii's, and the energy-preserving one.

#include "bsdf/oren_nayar.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

constexpr OrenNayarModel kModels[] = {OrenNayarModel::eon, OrenNayarModel::fujii,
                                      OrenNayarModel::qualitative};
const char* const kNames[] = {"eon", "fujii", "qualitative"};
const Spectrum kOrange(0.9f, 0.5f, 0.05f);

std::vector<TestedBsdf> models(Spectrum reflectance) {
  std::vector<TestedBsdf> all;
  for (const auto model : kModels)
    for (const float roughness : {0.0f, 0.01f, 0.3f, 0.7f, 1.0f})
      all.push_back(tested(fmt::format("{} {}", kNames[static_cast<int>(model)], roughness),
                           OrenNayar{reflectance, roughness, model}));
  return all;
}

TEST(OrenNayar, SamplesAgree) {
  for (const TestedBsdf& model : models(kOrange)) expect_samples_agree(model);
}

TEST(OrenNayar, Reciprocity) {
  for (const TestedBsdf& model : models(kOrange)) expect_reciprocal(model);
}

TEST(OrenNayar, IsLambertianWithoutRoughness) {
  for (const auto model : kModels) {
    const OrenNayar smooth{kOrange, 0, model};
    const vec3 wo = polar(1.2, 0.3), wi = polar(0.4, 2);
    EXPECT_NEAR(smooth.eval(wo, wi).x, 0.9f * wi.z * kInvPi, 1e-6);
    EXPECT_NEAR(smooth.pdf(wo, wi), wi.z * kInvPi, 1e-6);
  }
}

TEST(OrenNayar, IsThatOfThePapersInAngles) {
  std::mt19937_64 random(fresh_seed());
  std::uniform_real_distribution<double> uniform(0, 1);
  const double pi = std::numbers::pi;
  for (int i = 0; i < 2000; ++i) {
    const double theta_o = uniform(random) * 1.56, theta_i = uniform(random) * 1.56,
                 phi = uniform(random) * 2 * pi, r = uniform(random), rho = uniform(random);
    const double alpha = std::max(theta_o, theta_i), beta = std::min(theta_o, theta_i),
                 cos_phi = std::cos(phi);
    // Oren & Nayar 1994, the qualitative model.
    const double s2 = r * r, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
    const double qualitative = rho / pi * (a + b * std::max(0.0, cos_phi) * std::sin(alpha) * std::tan(beta));
    // EON, its albedo by quadrature.
    const double af = 1 / (1 + (0.5 - 2 / (3 * pi)) * r);
    auto fon = [&](double o, double in, double c) {
      const double s = std::sin(o) * std::sin(in) * c;
      return af * (1 + r * (s > 0 ? s / std::max(std::cos(o), std::cos(in)) : s)) / pi;
    };
    const vec3 wo = polar(theta_o, 0.7), wi = polar(theta_i, 0.7 + phi);
    const Spectrum reflectance(float(rho), 0, 1);
    auto f = [&](OrenNayarModel model) {
      return double(OrenNayar{reflectance, float(r), model}.eval(wo, wi).x) / std::cos(theta_i);
    };
    EXPECT_NEAR(f(OrenNayarModel::qualitative) / qualitative, 1, 2e-5)
        << r << ' ' << theta_o << ' ' << theta_i;
    EXPECT_NEAR(f(OrenNayarModel::fujii), rho * fon(theta_o, theta_i, cos_phi), 1e-5);
    if (i % 100 != 0) continue;
    auto albedo = [&](double theta) {
      double sum = 0;
      const int n = 400;
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          const double in = (j + 0.5) / n * pi / 2;
          sum += fon(theta, in, std::cos((k + 0.5) / n * pi)) * std::cos(in) * std::sin(in);
        }
      return sum * 2 * pi * pi / 2 / (n * n);
    };
    const double eo = albedo(theta_o), ei = albedo(theta_i);
    EXPECT_NEAR(double(OrenNayar::fujii_albedo(float(std::sin(theta_o)), float(std::cos(theta_o)), float(r))),
                eo, 2e-4);
    const double mean = af * (1 + (2.0 / 3 - 28 / (15 * pi)) * r);
    const double gain = rho * rho * mean / (1 - rho * (1 - mean));
    const double eon =
        rho * fon(theta_o, theta_i, cos_phi) + gain / pi * (1 - eo) * (1 - ei) / std::max(1 - mean, 1e-9);
    if (r > 0.05) { EXPECT_NEAR(f(OrenNayarModel::eon), eon, 3e-4); }
  }
}

TEST(OrenNayar, WhiteFurnaceOfEon) {
  for (const float roughness : {0.0f, 0.01f, 0.2f, 0.5f, 0.8f, 1.0f}) {
    const TestedBsdf white = tested("white", OrenNayar{Spectrum(1), roughness, OrenNayarModel::eon});
    for (const vec3 wo : contract_directions())
      EXPECT_NEAR(albedo_by_quadrature(white, wo).x, 1, 1e-3) << roughness << " wo.z " << wo.z;
    // And with it that of each sample stays near: importance sampling does its work.
    const SampledAlbedo sampled = albedo_by_samples(white, polar(1.5, 0.4), 20000);
    EXPECT_LT(sampled.channel[0].variance(), 0.15) << roughness;
  }
}

TEST(OrenNayar, EonSaturates) {
  // The albedo is rho E + rho_ms (1 - E), channel by channel.
  const float r = 0.8f;
  const OrenNayar eon{kOrange, r, OrenNayarModel::eon};
  const double mean =
      (1 + (2.0 / 3 - 28 / (15 * std::numbers::pi)) * 0.8) / (1 + (0.5 - 2 / (3 * std::numbers::pi)) * 0.8);
  for (const double theta : {0.0, 0.5, 1.2, 1.5}) {
    const vec3 albedo = albedo_by_quadrature(tested("eon", eon, 2), polar(theta, 1));
    const double e = double(OrenNayar::fujii_albedo(float(std::sin(theta)), float(std::cos(theta)), r));
    for (int c = 0; c < 3; ++c) {
      const auto rho = double(kOrange[c]);
      EXPECT_NEAR(double(albedo[c]), rho * e + rho * rho * mean / (1 - rho * (1 - mean)) * (1 - e), 1e-3);
    }
  }
}

TEST(OrenNayar, QualitativeModelExceedsOneByLittle) {
  float worst = 0;
  for (const float roughness : {0.05f, 0.1f, 0.15f, 0.2f, 0.5f, 1.0f})
    for (const double theta : {0.0, 1.0, 1.5, 1.57}) {
      const OrenNayar white{Spectrum(1), roughness, OrenNayarModel::qualitative};
      worst = std::max(worst, albedo_by_quadrature(tested("white", white), polar(theta, 0)).x);
    }
  EXPECT_GT(worst, 1.005f);
  EXPECT_LT(worst, 1.016f);
}

TEST(OrenNayarStatistical, DirectionsFollowThePdf) {
  const auto all = models(kOrange);
  const auto directions = contract_directions();
  for (const TestedBsdf& model : all)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(all.size() * directions.size()), 30000);
}

TEST(OrenNayarStatistical, EnergyIsConserved) {
  const auto all = models(kOrange);
  for (const TestedBsdf& model : all) expect_conserves_energy(model, static_cast<int>(all.size()));
}

} // namespace
} // namespace candela::test
