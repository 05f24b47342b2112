// Smooth and rough metals and dielectrics of microfacets.

#include "bsdf/conductor.h"
#include "bsdf/rough_dielectric.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>

namespace candela::test {
namespace {

constexpr MicrofacetDistribution kDistributions[] = {MicrofacetDistribution::ggx,
                                                     MicrofacetDistribution::beckmann};

struct Roughness {
  float x, y;
};
constexpr Roughness kAlphas[] = {{0.001f, 0.001f}, {0.05f, 0.05f}, {0.3f, 0.3f},
                                 {1, 1},           {0.4f, 0.1f},   {0.02f, 0.6f}};

/// Gold at three wavelengths.
const Spectrum kGoldEta(0.143f, 0.375f, 1.442f), kGoldK(3.983f, 2.386f, 1.603f);

std::vector<TestedBsdf> rough_models() {
  std::vector<TestedBsdf> models;
  for (const auto distribution : kDistributions)
    for (const auto [x, y] : kAlphas) {
      const Microfacets facets{distribution, x, y};
      const std::string name =
          fmt::format("{} {} {}", distribution == MicrofacetDistribution::ggx ? "ggx" : "beckmann", x, y);
      const double width = std::min(2.0, 2 * double(std::max(x, y)));
      models.push_back(tested("conductor " + name, Conductor{kGoldEta, kGoldK, Spectrum(1), facets}, width));
      for (const float ior : {1.5f, 1 / 1.33f})
        models.push_back(tested(fmt::format("dielectric {} {}", ior, name),
                                RoughDielectric{ior, Spectrum(1), facets}, width, ior));
    }
  return models;
}

TEST(FacetModels, SamplesAgree) {
  for (const TestedBsdf& model : rough_models()) expect_samples_agree(model);
}

TEST(FacetModels, Reciprocity) {
  // The half vector of a refraction is a difference of nearly equal directions: fewer digits, fewest of
  // narrow lobes.
  for (const TestedBsdf& model : rough_models())
    expect_reciprocal(model, 20000, model.ior == 1 ? 2e-5f : static_cast<float>(1e-4 + 1e-6 / model.width));
}

TEST(Microfacets, AlbedoOfTheFirstBounce) {
  // Without loss at the facets; computed in double by others.
  struct Known {
    float alpha, albedo[3];
  };
  for (const auto& [alpha, known] :
       {Known{0.5f, {0.6879f, 0.6983f, 0.8601f}}, Known{1, {0.3069f, 0.4507f, 0.7602f}}}) {
    const Conductor lossless{
        Spectrum(0), Spectrum(1), Spectrum(1), {MicrofacetDistribution::ggx, alpha, alpha}};
    const TestedBsdf model = tested("lossless", lossless, 2 * double(alpha));
    for (int i = 0; const float cosine : {1.0f, 0.5f, 0.1f}) {
      const vec3 wo(std::sqrt(1 - sqr(cosine)), 0, cosine);
      EXPECT_NEAR(albedo_by_quadrature(model, wo).x, known[i], 2e-4) << alpha << ' ' << cosine;
      EXPECT_NEAR(FacetAlbedo::of(MicrofacetDistribution::ggx, false)(lossless.facets, wo), known[i], 1e-3)
          << alpha << ' ' << cosine;
      ++i;
    }
  }
}

TEST(Microfacets, WhiteFurnaceWithCompensation) {
  for (const auto distribution : kDistributions)
    for (const float alpha : {0.05f, 0.2f, 0.5f, 0.8f, 1.0f}) {
      const Conductor conductor{Spectrum(0), Spectrum(1),
                                Spectrum(1), {distribution, alpha, alpha},
                                false,       &FacetAlbedo::of(distribution, false)};
      const TestedBsdf model = tested("lossless", conductor, 2 * double(alpha));
      for (const float cosine : {1.0f, 0.7f, 0.3f, 0.1f, 0.03f}) {
        const vec3 wo(std::sqrt(1 - sqr(cosine)), 0, cosine);
        EXPECT_NEAR(albedo_by_quadrature(model, wo).x, 1, 3e-3) << alpha << ' ' << cosine;
      }
    }
}

TEST(Microfacets, WhiteFurnaceOfGlassWithCompensation) {
  for (const auto distribution : kDistributions)
    for (const float alpha : {0.05f, 0.2f, 0.5f, 1.0f})
      for (const float ior : {1.5f, 1.1f, 1 / 1.33f}) {
        const TestedBsdf model = tested(
            "glass",
            RoughDielectric{
                ior, Spectrum(1), {distribution, alpha, alpha}, false, &InterfaceAlbedo::of(distribution)},
            2 * double(alpha), ior);
        for (const float cosine : {1.0f, 0.7f, 0.3f, 0.1f, -0.2f, -0.6f, -0.95f}) {
          const vec3 wo(std::sqrt(1 - sqr(cosine)), 0, cosine);
          EXPECT_NEAR(albedo_by_quadrature(model, wo).x, 1, ior > 1.2f || ior < 0.8f ? 1e-2 : 3e-2)
              << alpha << ' ' << ior << ' ' << cosine;
        }
      }
}

TEST(Microfacets, AnisotropicAlbedo) {
  for (const auto [x, y] : {Roughness{0.4f, 0.1f}, Roughness{0.1f, 0.8f}, Roughness{0.3f, 0.9f}})
    for (const float azimuth : {0.0f, 0.8f, 1.5f, -2.0f})
      for (const float cosine : {0.95f, 0.4f, 0.1f}) {
        const Conductor conductor{Spectrum(0), Spectrum(1),
                                  Spectrum(1), {MicrofacetDistribution::ggx, x, y},
                                  false,       &FacetAlbedo::of(MicrofacetDistribution::ggx, true)};
        const float sine = std::sqrt(1 - sqr(cosine));
        const vec3 wo(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
        EXPECT_NEAR(albedo_by_quadrature(tested("lossless", conductor, double(x + y)), wo).x, 1, 1e-2)
            << x << ' ' << y << ' ' << azimuth << ' ' << cosine;
      }
}

TEST(Conductor, FresnelOfAComplexIndex) {
  // Against the amplitudes of both polarisations in complex numbers.
  for (const auto& [eta, k] :
       {std::pair(0.143, 3.983), std::pair(1.442, 1.603), std::pair(2.9, 3.1), std::pair(1.5, 0.0)})
    for (double theta = 0; theta < 1.57; theta += 0.1) {
      const std::complex<double> n(eta, k);
      const double cosine = std::cos(theta);
      const auto cos_t = std::sqrt(1.0 - (1 - cosine * cosine) / (n * n));
      const auto s = (cosine - n * cos_t) / (cosine + n * cos_t),
                 p = (n * cosine - cos_t) / (n * cosine + cos_t);
      const double exact = 0.5 * (std::norm(s) + std::norm(p));
      EXPECT_NEAR(fresnel_conductor(float(cosine), Spectrum(float(eta)), Spectrum(float(k))).x, exact, 2e-6)
          << eta << ' ' << theta;
    }
}

TEST(Fresnel, WhatPassesIsTheRest) {
  for (const float eta : {1.5f, 1 / 1.5f, 1.1f})
    for (float cosine = 0.05f; cosine <= 1; cosine += 0.05f) {
      const float cos2 = 1 - (1 - sqr(cosine)) / sqr(eta);
      if (cos2 <= 0) continue;
      EXPECT_NEAR(fresnel_dielectric_transmittance(cosine, std::sqrt(cos2), eta),
                  1 - fresnel_dielectric(cosine, eta), 1e-6);
    }
}

TEST(FacetModelsStatistical, DirectionsFollowThePdf) {
  const auto models = rough_models();
  const auto directions = contract_directions();
  for (const TestedBsdf& model : models)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(models.size() * directions.size()), 20000);
}

TEST(FacetModelsStatistical, EnergyIsConserved) {
  const auto models = rough_models();
  for (const TestedBsdf& model : models) expect_conserves_energy(model, static_cast<int>(models.size()));
}

} // namespace
} // namespace candela::test
