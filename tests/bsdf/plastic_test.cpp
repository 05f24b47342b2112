// A diffuse base under a smooth or a rough coat.

#include "bsdf/plastic.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace candela::test {
namespace {

const Spectrum kDullOrange(0.6f, 0.3f, 0.1f);
constexpr MicrofacetDistribution kPlasticDistributions[] = {MicrofacetDistribution::ggx,
                                                            MicrofacetDistribution::beckmann};

Plastic smooth(Spectrum diffuse, Spectrum specular = Spectrum(1), float ior = 1.5f, bool nonlinear = false) {
  return {diffuse, specular, ior, nonlinear};
}
Plastic rough(float alpha, MicrofacetDistribution distribution, Spectrum diffuse,
              Spectrum specular = Spectrum(1), float ior = 1.5f, bool nonlinear = false) {
  return {diffuse, specular, ior, nonlinear, {distribution, alpha, alpha}, &CoatAlbedo::of(distribution)};
}

std::vector<TestedBsdf> smooth_models() {
  std::vector<TestedBsdf> models;
  for (const auto& [ior, nonlinear] : {std::pair(1.0f, false), std::pair(1.5f, true), std::pair(3.0f, false)})
    models.push_back(tested(fmt::format("smooth {} {}", ior, nonlinear),
                            smooth(kDullOrange, Spectrum(1, 0.8f, 0.9f), ior, nonlinear)));
  models.push_back(tested("smooth without base", smooth(Spectrum(0))));
  models.push_back(tested("smooth without reflection", smooth(kDullOrange, Spectrum(0))));
  return models;
}

std::vector<TestedBsdf> rough_plastics() {
  std::vector<TestedBsdf> models;
  for (const auto distribution : kPlasticDistributions)
    for (const float alpha : {0.001f, 0.05f, 0.3f, 1.0f}) {
      if (distribution == MicrofacetDistribution::beckmann && alpha != 0.05f && alpha != 0.3f) continue;
      const std::string name =
          fmt::format("{} {}", distribution == MicrofacetDistribution::ggx ? "ggx" : "beckmann", alpha);
      const double width = std::min(2.0, 2 * double(alpha));
      models.push_back(tested(name, rough(alpha, distribution, kDullOrange), width));
      if (alpha == 0.3f)
        models.push_back(tested(name + " nonlinear",
                                rough(alpha, distribution, kDullOrange, Spectrum(0.9f), 1.9f, true), width));
    }
  models.push_back(tested("without base", rough(0.2f, MicrofacetDistribution::ggx, Spectrum(0)), 0.4));
  models.push_back(
      tested("without reflection", rough(0.2f, MicrofacetDistribution::ggx, kDullOrange, Spectrum(0)), 2));
  return models;
}

std::vector<TestedBsdf> all_models() {
  std::vector<TestedBsdf> all = smooth_models();
  for (auto& model : rough_plastics()) all.push_back(std::move(model));
  return all;
}

TEST(Plastic, SamplesAgree) {
  for (const TestedBsdf& model : all_models()) expect_samples_agree(model);
}

TEST(Plastic, Reciprocity) {
  for (const TestedBsdf& model : all_models()) expect_reciprocal(model);
}

TEST(Plastic, DiffuseFresnelReflectance) {
  EXPECT_NEAR(diffuse_fresnel_reflectance(1.5f), 0.091778, 1e-6);
  EXPECT_NEAR(internal_diffuse_reflectance(diffuse_fresnel_reflectance(1.5f), 1.5f), 0.596346, 1e-6);
  EXPECT_EQ(diffuse_fresnel_reflectance(1), 0);
  for (const float eta : {1.001f, 1.1f, 1.33f, 1.8f, 3.0f}) {
    // Means over the cosine, whose square is uniform.
    double outside = 0, inside = 0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
      const auto cosine = float(std::sqrt((i + 0.5) / n));
      outside += double(fresnel_dielectric(cosine, eta)) / n;
      inside += double(fresnel_dielectric(cosine, 1 / eta)) / n;
    }
    const float closed = diffuse_fresnel_reflectance(eta);
    EXPECT_NEAR(double(closed), outside, 2e-5) << eta;
    EXPECT_NEAR(double(internal_diffuse_reflectance(closed, eta)), inside, 2e-5) << eta;
  }
}

TEST(Plastic, IsThatOfMitsuba) {
  // plastic and roughplastic of mitsuba 3.9.1, scalar_rgb, int_ior 1.5, ext_ior 1, diffuse_reflectance
  // (.6, .3, .1): bsdf.eval(BSDFContext(), si, wi)[0], si.wi = wo; theta and phi of wo and wi.
  struct Known {
    double o[2], i[2];
    float linear, nonlinear, ggx, beckmann;
  };
  for (const Known& k : {Known{{0.5, 0}, {1.0, 0.4}, 0.1006032f, 0.0631894f, 0.00121497f, 0},
                         Known{{0.5, 0}, {0.55, 3.0}, 0.1648688f, 0.1035549f, 0.0393634f, 0.3005048f},
                         Known{{1.3, 0}, {1.2, 3.1}, 0.0487578f, 0.0306250f, 0.4021029f, 3.0575314f},
                         Known{{0.2, 0}, {1.4, 2}, 0.0207776f, 0.0130505f, 0.00116905f, 0}}) {
    const vec3 wo = polar(k.o[0], k.o[1]), wi = polar(k.i[0], k.i[1]);
    // It has a fit for the reflectance of diffuse light.
    EXPECT_NEAR(smooth(kDullOrange).eval(wo, wi).x / k.linear, 1, 2e-3);
    EXPECT_NEAR(smooth(kDullOrange, Spectrum(1), 1.5f, true).eval(wo, wi).x / k.nonlinear, 1, 1e-3);
    // Only the coat, of alpha 0.3 and 0.1, for of white light its rough coat loses some 30 % at alpha 0.3.
    // Masking and shadowing do not correlate.
    for (const auto& [coat, known] :
         {std::pair(rough(0.3f, MicrofacetDistribution::ggx, Spectrum(0)), k.ggx),
          std::pair(rough(0.1f, MicrofacetDistribution::beckmann, Spectrum(0)), k.beckmann)}) {
      const float apart = coat.facets.g1(wo) * coat.facets.g1(wi) / coat.facets.g2_reflection(wo, wi);
      EXPECT_NEAR(coat.eval(wo, wi).x * apart, known, 1e-6 + 2e-5 * double(known));
    }
  }
}

TEST(Plastic, WhiteFurnaceOfASmoothCoat) {
  for (const float ior : {1.0f, 1.2f, 1.5f, 2.5f})
    for (const double theta : {0.0, 0.7, 1.3, 1.5, 2.0}) {
      const vec3 wo = polar(theta, 1);
      const Plastic white = smooth(Spectrum(1), Spectrum(1), ior);
      const double mirrored = double(fresnel_dielectric(std::abs(wo.z), ior));
      EXPECT_NEAR(double(albedo_by_quadrature(tested("white", white), wo).x) + mirrored, 1, 1e-3) << ior;
      // Lobes that are chosen by what they reflect give samples that all weigh much the same.
      const SampledAlbedo sampled = albedo_by_samples(tested("white", white), wo, 20000);
      EXPECT_NEAR(sampled.channel[0].mean(), 1, 1e-2) << ior;
      EXPECT_LT(sampled.channel[0].variance(), 0.03) << ior;
    }
}

TEST(Plastic, WhiteFurnaceOfARoughCoat) {
  for (const auto distribution : kPlasticDistributions)
    for (const float alpha : {0.05f, 0.2f, 0.5f, 1.0f})
      for (const float ior : {1.1f, 1.5f, 2.5f})
        for (const double theta : {0.0, 0.7, 1.3, 1.5}) {
          const TestedBsdf white =
              tested("white", rough(alpha, distribution, Spectrum(1), Spectrum(1), ior), 2 * double(alpha));
          EXPECT_NEAR(albedo_by_quadrature(white, polar(theta, 1)).x, 1, 2e-3)
              << alpha << ' ' << ior << ' ' << theta;
        }
}

TEST(Plastic, ColorsOfTheBase) {
  // By summing up what is thrown back k times.
  for (const double rho : {0.2, 0.9}) {
    const double inside = 0.596346, passes = 1 - 0.091778;
    double sum = 0, power = rho;
    for (int k = 0; k < 400; ++k, power *= rho * inside) sum += power;
    // What leaves of what enters: the base's light crosses the coat, diffuse.
    const Plastic coated = smooth(Spectrum(float(rho)), Spectrum(1), 1.5f, true);
    EXPECT_NEAR(double(coated.base_albedo().x), sum * (1 - inside), 1e-4);
    EXPECT_NEAR(double(coated.mean_transmittance), passes, 1e-5);
    EXPECT_FLOAT_EQ(smooth(Spectrum(float(rho))).base_albedo().x, float(rho));
  }
}

TEST(Plastic, RoughCoatBecomesSmooth) {
  const vec3 wo = polar(0.6, 0), wi = polar(1, 2);
  for (const auto distribution : kPlasticDistributions)
    EXPECT_NEAR(rough(0.001f, distribution, kDullOrange).eval(wo, wi).x / smooth(kDullOrange).eval(wo, wi).x,
                1, 2e-3);
}

TEST(PlasticStatistical, DirectionsFollowThePdf) {
  const auto models = all_models();
  const auto directions = contract_directions();
  for (const TestedBsdf& model : models)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(models.size() * directions.size()), 20000);
}

TEST(PlasticStatistical, EnergyIsConserved) {
  const auto models = all_models();
  for (const TestedBsdf& model : models) expect_conserves_energy(model, static_cast<int>(models.size()));
}

} // namespace
} // namespace candela::test
