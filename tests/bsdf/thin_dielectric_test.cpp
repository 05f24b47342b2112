#include "bsdf/thin_dielectric.h"
#include "support/bsdf_contract.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace candela::test {
namespace {

vec3 tilted(float degrees_from_normal) {
  const float theta = radians(degrees_from_normal);
  return {std::sin(theta), 0, std::cos(theta)};
}

/// Both lobes, each times the probability of its choice: u.lobe near 0 reflects, near 1 passes.
BsdfSample reflected(const ThinDielectric& pane, vec3 wo) { return *pane.sample(wo, vec3(0.3f, 0.6f, 0)); }
BsdfSample passed(const ThinDielectric& pane, vec3 wo) {
  return *pane.sample(wo, vec3(0.3f, 0.6f, kOneMinusEpsilon));
}

TEST(ThinDielectric, KnownShares) {
  const ThinDielectric pane;
  for (const auto& [angle, r, t] :
       {std::tuple(0.0f, 0.076923f, 0.923077f), std::tuple(60.0f, 0.163768f, 0.836232f),
        // Mitsuba 3.9.1, thindielectric, int_ior 1.5, ext_ior 1: pdf of
        // bsdf.sample(ctx, si, 0, [.5, .5]) and of bsdf.sample(ctx, si, .9999, ...)
        std::tuple(85.0f, 0.7599204f, 0.2400796f), std::tuple(120.0f, 0.1637675f, 0.8362325f)}) {
    const vec3 wo = tilted(angle);
    const BsdfSample mirrored = reflected(pane, wo), straight = passed(pane, wo);
    EXPECT_NEAR(mirrored.pdf, r, 1e-6) << angle;
    EXPECT_NEAR(straight.pdf, t, 1e-6) << angle;
    EXPECT_EQ(mirrored.wi, reflect_about_normal(wo));
    EXPECT_EQ(straight.wi, -wo);
    for (const BsdfSample& s : {mirrored, straight}) {
      EXPECT_TRUE(s.delta);
      EXPECT_EQ(s.eta, 1);
      EXPECT_NEAR(s.weight.y, 1, 1e-6);
    }
  }
}

TEST(ThinDielectric, SumOfTheReflectionsBetweenTheFaces) {
  for (const double n : {1.05, 1.33, 1.5, 2.4, 1 / 1.5})
    for (double theta = 0; theta < 1.57; theta += 0.1) {
      const double sin_t = std::sin(theta) / n;
      if (sin_t >= 0.999) continue;
      const double cos_i = std::cos(theta), cos_t = std::sqrt(1 - sin_t * sin_t);
      const double s = (cos_i - n * cos_t) / (cos_i + n * cos_t),
                   p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
      const double face = 0.5 * (s * s + p * p);
      // A ray that entered, again and again: after each reflection inside a part of it leaves.
      double up = face, down = 0, inside = 1 - face;
      for (int bounce = 0; bounce < 2000; ++bounce) {
        (bounce % 2 == 0 ? down : up) += inside * (1 - face);
        inside *= face;
      }
      const ThinDielectric pane{static_cast<float>(n)};
      EXPECT_NEAR(pane.sheet_reflectance(static_cast<float>(cos_i)), up, 2e-6) << n << ' ' << theta;
      EXPECT_NEAR(up + down, 1, 1e-9);
    }
}

TEST(ThinDielectric, Tints) {
  const ThinDielectric pane{1.5f, {0.9f, 0.5f, 0.2f}, {0.3f, 0.6f, 0.8f}};
  const float r = 0.1637675f;
  const vec3 wo = tilted(60);
  const BsdfSample mirrored = reflected(pane, wo), straight = passed(pane, wo);
  EXPECT_NEAR(mirrored.pdf + straight.pdf, 1, 1e-6);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mirrored.weight[c] * mirrored.pdf, r * pane.reflectance[c], 1e-6);
    EXPECT_NEAR(straight.weight[c] * straight.pdf, (1 - r) * pane.transmittance[c], 1e-6);
  }
  EXPECT_NEAR(pane.albedo().x, 0.9 / 13 + 0.3 * 12 / 13, 1e-6);
}

TEST(ThinDielectric, BlackLobesAreNotChosen) {
  const ThinDielectric absorbs{1.5f, Spectrum(1), Spectrum(0)}, coated{1.5f, Spectrum(0), Spectrum(1)};
  for (const float u : {0.0f, 0.5f, kOneMinusEpsilon}) {
    EXPECT_GT(absorbs.sample(tilted(30), vec3(0.5f, 0.5f, u))->wi.z, 0);
    EXPECT_LT(coated.sample(tilted(30), vec3(0.5f, 0.5f, u))->wi.z, 0);
    EXPECT_FALSE((ThinDielectric{1.5f, Spectrum(0), Spectrum(0)}.sample(tilted(30), vec3(0.5f, 0.5f, u))));
  }
}

TEST(ThinDielectric, KeepsTheContract) {
  for (const float ior : {0.1f, 1 / 1.5f, 1.0f, 1.5f, 10.0f})
    for (const Spectrum tint : {Spectrum(1), Spectrum(0.2f, 0.5f, 0)}) {
      const TestedBsdf model =
          tested(fmt::format("pane {} {}", ior, tint.x), ThinDielectric{ior, tint, tint});
      expect_samples_agree(model);
      expect_reciprocal(model, 1000);
      expect_conserves_energy(model, 10);
      // Nothing is lost but by the tint.
      for (const vec3 wo : contract_directions()) {
        const SampledAlbedo albedo = albedo_by_samples(model, wo, 1000);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(albedo.channel[c].mean(), double(tint[c]), 1e-5);
      }
    }
}

} // namespace
} // namespace candela::test
