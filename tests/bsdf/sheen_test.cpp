// Cloth: a sheen lobe over a matte base.

#include "bsdf/sheen.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

constexpr float kRoughnesses[] = {SheenAlbedo::kMinRoughness, 0.15f, 0.4f, 1};

std::vector<TestedBsdf> sheen_models() {
  std::vector<TestedBsdf> all;
  for (const float r : kRoughnesses) {
    all.push_back(tested(fmt::format("lobe {}", r), Sheen{Spectrum(0), Spectrum(0.9f), r}));
    all.push_back(
        tested(fmt::format("both {}", r), Sheen{Spectrum(0.9f, 0.1f, 0.6f), Spectrum(0.2f, 1, 0.4f), r}));
  }
  return all;
}

TEST(Sheen, SamplesAgree) {
  for (const TestedBsdf& model : sheen_models()) expect_samples_agree(model);
}

TEST(Sheen, Reciprocity) {
  for (const TestedBsdf& model : sheen_models()) expect_reciprocal(model);
}

TEST(Sheen, IsThatOfThePapersInAngles) {
  std::mt19937_64 random(fresh_seed());
  std::uniform_real_distribution<double> uniform(0, 1);
  const double pi = std::numbers::pi;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(seed_note());
    const double to = uniform(random) * 1.55, ti = uniform(random) * 1.55, phi = uniform(random) * 2 * pi,
                 r = 0.3 + 0.7 * uniform(random);
    const double co = std::cos(to), ci = std::cos(ti);
    const double cos_h =
        (co + ci) / std::sqrt(2 + 2 * (co * ci + std::sin(to) * std::sin(ti) * std::cos(phi)));
    const double d = (2 + 1 / r) * std::pow(std::sin(std::acos(std::min(cos_h, 1.0))), 1 / r) / (2 * pi);
    const double exact = d / (4 * (co + ci - co * ci));
    // Of these roughnesses the lobe needs no scale.
    const Sheen sheen{Spectrum(0), Spectrum(0.5f), float(r)};
    const double value = double(sheen.eval(polar(to, 1), polar(ti, 1 + phi)).x) / ci;
    EXPECT_NEAR(value, 0.5 * exact, 1e-6 + 1e-4 * exact) << r;
  }
}

TEST(Sheen, DistributionOfNormalsIsNormalised) {
  // D cos(theta_h) over the hemisphere is 1; D is four times the lobe of wi = wo = h, by its visibility. The
  // whole of a hemisphere is in it.
  for (const double r : {0.05, 0.3, 1.0}) {
    double sum = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double cosine = (i + 0.5) / n;
      const vec3 h = polar(std::acos(cosine), 0);
      const double d = double(sheen_lobe(h, h, float(r))) * 4 * cosine * (2 - cosine);
      sum += 2 * std::numbers::pi * d * cosine / n;
    }
    EXPECT_NEAR(sum, 1, 1e-4) << r;
  }
}

TEST(Sheen, TableIsTheAlbedo) {
  const SheenAlbedo& table = SheenAlbedo::table();
  for (const float r : {0.05f, 0.08f, 0.2f, 0.33f, 0.6f, 1.0f}) {
    const TestedBsdf lobe = tested("lobe", Sheen{Spectrum(0), Spectrum(1), r});
    for (const double theta : {0.0, 0.6, 1.2, 1.4, 1.52, 1.56}) {
      const vec3 wo = polar(theta, 1);
      EXPECT_NEAR(albedo_by_quadrature(lobe, wo).x, table(r, wo.z) * table.scale(r), 5e-4)
          << r << ' ' << theta;
    }
  }
  EXPECT_EQ(table.scale(0.5f), 1);
  EXPECT_LT(table.scale(0.1f), 0.8f);
}

TEST(Sheen, BaseGetsWhatTheLobeLeaves) {
  const vec3 wo = polar(1.2, 0), wi = polar(0.5, 2);
  for (const float r : kRoughnesses) {
    const float base = Sheen{Spectrum(0.8f), Spectrum(0), r}.eval(wo, wi).x;
    EXPECT_NEAR(base, 0.8f * wi.z * kInvPi, 1e-6);
    const Spectrum tint(0.3f, 0.6f, 0);
    const float both = Sheen{Spectrum(0.8f), tint, r}.eval(wo, wi).z; // blue has no sheen
    const float lobe = albedo_by_quadrature(tested("lobe", Sheen{Spectrum(0), Spectrum(1), r}), wo).x;
    EXPECT_NEAR(both / base, 1 - 0.6f * lobe, 5e-4); // wo is the more grazing one
  }
}

TEST(Sheen, WhiteClothKeepsWithinOne) {
  for (const float r : {0.05f, 0.1f, 0.2f, 0.5f, 1.0f}) {
    const TestedBsdf white = tested("white", Sheen{Spectrum(1), Spectrum(1), r});
    for (const vec3 wo : contract_directions()) {
      const float albedo = albedo_by_quadrature(white, wo).x;
      EXPECT_LE(albedo, 1 + 1e-4f) << r << " wo.z " << wo.z;
      EXPECT_GE(albedo, 0.7f) << r << " wo.z " << wo.z;
    }
  }
}

TEST(SheenStatistical, DirectionsFollowThePdf) {
  const auto all = sheen_models();
  const auto directions = contract_directions();
  for (const TestedBsdf& model : all)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(all.size() * directions.size()), 30000);
}

TEST(SheenStatistical, EnergyIsConserved) {
  const auto all = sheen_models();
  for (const TestedBsdf& model : all) expect_conserves_energy(model, static_cast<int>(all.size()));
}

} // namespace
} // namespace candela::test
