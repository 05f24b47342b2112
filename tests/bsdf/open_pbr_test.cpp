// OpenPBR: each of its corners against what it comes to, energy, and the contract.

#include "bsdf/rough_dielectric.h"
#include "materials/open_pbr_material.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

constexpr OpenPbrValues kBlack{.base_color = Spectrum(0), .specular_weight = 0};

vec3 at_degrees(float degrees, float phi) {
  const float theta = radians(degrees);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
const vec3 kAbove[] = {at_degrees(10, 0.2f), at_degrees(35, 3.0f), at_degrees(60, 1.0f), at_degrees(75, 2.5f),
                       at_degrees(85, -2)};

template <class F>
void for_pairs(F f) {
  for (const vec3 wo : kAbove)
    for (const vec3 wi : kAbove) f(wo, wi);
}
void expect_relative(vec3 value, vec3 expected, float relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], relative * expected[c] + 1e-7f);
}
vec3 albedo(const OpenPbrValues& v, vec3 wo, double width) {
  return albedo_by_quadrature(tested("open_pbr", OpenPbr{v}, width, open_pbr::eta(v)), wo);
}

std::vector<TestedBsdf> open_pbr_models() {
  std::vector<TestedBsdf> all;
  const auto add = [&](const OpenPbrValues& v) {
    double rough = double(open_pbr::base_roughness(v));
    if (v.coat_weight > 0) rough = std::min(rough, double(v.coat_roughness));
    const double alpha = std::max(rough * rough, 1e-3);
    all.push_back(tested(fmt::format("open_pbr {}", all.size()), OpenPbr{v}, std::min(2.0, 2 * alpha),
                         std::max(open_pbr::eta(v), 1.02f)));
  };
  add({});
  add({.base_metalness = 1, .specular_color = {0.5f, 0.8f, 1}, .specular_roughness_anisotropy = 0.6f});
  add({.base_color = {0.8f, 0.3f, 0.1f},
       .base_diffuse_roughness = 0.8f,
       .specular_roughness = 0.6f,
       .coat_weight = 1,
       .coat_color = {0.9f, 0.5f, 0.2f},
       .coat_roughness = 0.3f});
  add({.specular_roughness = 0.4f, .transmission_weight = 1, .transmission_color = {0.4f, 0.9f, 1}});
  add({.base_color = {0.2f, 0.5f, 0.8f},
       .base_metalness = 0.3f,
       .specular_roughness = 0.5f,
       .transmission_weight = 0.5f,
       .transmission_color = {0.4f, 0.9f, 1},
       .coat_weight = 0.5f,
       .coat_color = {1, 0.5f, 0.5f},
       .coat_roughness = 0.4f,
       .fuzz_weight = 0.7f,
       .fuzz_color = {1, 0.2f, 0.1f}});
  add({.base_color = Spectrum(0.1f),
       .fuzz_weight = 1,
       .fuzz_color = {0.4f, 0.5f, 1},
       .fuzz_roughness = 0.2f});
  add({.specular_roughness = 0.3f,
       .transmission_weight = 1,
       .thin_film_weight = 1,
       .thin_film_thickness = 0.3f});
  add({.base_metalness = 0.5f, .specular_roughness = 0.35f, .thin_film_weight = 0.8f, .thin_film_ior = 2});
  // Extremes.
  add({.base_color = Spectrum(1), .specular_roughness = 1, .specular_ior = 3, .transmission_weight = 0.5f});
  add(kBlack);
  add({.base_color = {0, 0, 1},
       .base_diffuse_roughness = 1,
       .specular_weight = 10,
       .specular_roughness = 1,
       .specular_roughness_anisotropy = 1,
       .coat_weight = 1,
       .coat_color = Spectrum(0),
       .coat_roughness = 1,
       .coat_roughness_anisotropy = 1,
       .coat_ior = 3,
       .fuzz_weight = 1,
       .fuzz_roughness = 0});
  add({.base_color = Spectrum(1),
       .specular_weight = 0,
       .specular_roughness = 0.5f,
       .transmission_weight = 1});
  return all;
}

/// Nothing is absorbed.
struct White {
  OpenPbrValues values;
  float loss; ///< at most, but for the most grazing directions
};
std::vector<White> whites() {
  OpenPbrValues plain{.base_color = Spectrum(1)};
  std::vector<White> all;
  for (const float roughness : {0.2f, 0.5f, 1.0f}) {
    OpenPbrValues v = plain;
    v.specular_roughness = roughness;
    all.push_back({v, 0.02f});
    v.base_diffuse_roughness = 1;
    all.push_back({v, 0.02f});
    v.coat_weight = 1, v.coat_roughness = 0.4f;
    all.push_back({v, 0.02f});
    v.fuzz_weight = 1;
    all.push_back({v, 0.02f});
    v = plain, v.specular_roughness = roughness, v.base_metalness = 1;
    all.push_back({v, 0.02f});
    v.base_metalness = 0, v.transmission_weight = 1;
    all.push_back({v, 0.02f});
    v.transmission_weight = 0.5f, v.base_metalness = 0.4f, v.coat_weight = 0.5f, v.fuzz_weight = 0.5f;
    v.coat_roughness = 0.5f;
    all.push_back({v, 0.03f});
  }
  return all;
}

TEST(OpenPbr, PureDiffuseIsEon) {
  const OpenPbr model{
      {.base_color = {0.9f, 0.5f, 0.1f}, .base_diffuse_roughness = 0.7f, .specular_weight = 0}};
  const OrenNayar eon{{0.9f, 0.5f, 0.1f}, 0.7f};
  for_pairs([&](vec3 wo, vec3 wi) { expect_relative(model.eval(wo, wi), eon.eval(wo, wi), 1e-5f); });
}

TEST(OpenPbr, PureMetalIsF82OnFacets) {
  const OpenPbr model{{.base_color = {0.9f, 0.5f, 0.1f},
                       .base_metalness = 1,
                       .specular_weight = 0.8f,
                       .specular_color = {0.7f, 1, 0.8f},
                       .specular_roughness = 0.5f}};
  const Microfacets facets{MicrofacetDistribution::ggx, 0.25f, 0.25f};
  const F82Tint metal{model.base_color, model.specular_color};
  for_pairs([&](vec3 wo, vec3 wi) {
    const vec3 h = glm::normalize(wo + wi);
    const Spectrum once =
        0.8f * metal(glm::dot(wo, h)) * (facets.d(h) * facets.g2_reflection(wo, wi) / (4 * wo.z));
    const float share = FacetAlbedo::of(MicrofacetDistribution::ggx, false)(facets, wo);
    expect_relative(model.eval(wo, wi), once * multiple_scattering_gain(share, 0.8f * model.base_color),
                    5e-3f);
  });
}

TEST(OpenPbr, PureGlassIsARoughDielectric) {
  const OpenPbr model{
      {.specular_roughness = 0.5f, .transmission_weight = 1, .transmission_color = {0.4f, 0.9f, 1}}};
  const RoughDielectric glass{1.5f,
                              {0.4f, 0.9f, 1},
                              {MicrofacetDistribution::ggx, 0.25f, 0.25f},
                              false,
                              &InterfaceAlbedo::of(MicrofacetDistribution::ggx)};
  for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance})
    for (const vec3 sides : {vec3(1, 1, 0), vec3(1, -1, 0), vec3(-1, 1, 0), vec3(-1, -1, 0)})
      for_pairs([&](vec3 wo, vec3 wi) {
        wo.z *= sides.x, wi.z *= sides.y;
        expect_relative(model.eval(wo, wi, mode), glass.eval(wo, wi, mode), 7e-3f);
      });
}

TEST(OpenPbr, PureCoatIsItsFacets) {
  OpenPbr model{kBlack};
  model.coat_weight = 1, model.coat_roughness = 0.6f;
  const Microfacets facets{MicrofacetDistribution::ggx, 0.36f, 0.36f};
  for_pairs([&](vec3 wo, vec3 wi) {
    // The base's facets have an index that is not quite the coat's, and no weight.
    const vec3 h = glm::normalize(wo + wi);
    const float once =
        fresnel_dielectric(glm::dot(wo, h), 1.6f) * facets.d(h) * facets.g2_reflection(wo, wi) / (4 * wo.z);
    expect_relative(model.eval(wo, wi), Spectrum(once), 1e-5f);
  });
}

TEST(OpenPbr, PureFuzzIsItsLobe) {
  OpenPbr model{kBlack};
  model.fuzz_weight = 1, model.fuzz_color = {1, 0.6f, 0.2f}, model.fuzz_roughness = 0.4f;
  for (const vec3 wo : kAbove) {
    const Fuzz fuzz(0.4f, wo);
    for (const vec3 wi : kAbove)
      expect_relative(model.eval(wo, wi), model.fuzz_color * (fuzz.albedo() * fuzz.pdf(wi)), 1e-5f);
    expect_relative(albedo(model, wo, 1), model.fuzz_color * fuzz.albedo(), 1e-3f);
  }
}

TEST(OpenPbr, GlossyDiffuseIsTheSumOfBoth) {
  const OpenPbr model{
      {.base_color = {0.9f, 0.5f, 0.1f}, .specular_color = {1, 0.5f, 0.5f}, .specular_roughness = 0.5f}};
  const Microfacets facets{MicrofacetDistribution::ggx, 0.25f, 0.25f};
  for_pairs([&](vec3 wo, vec3 wi) {
    const vec3 h = glm::normalize(wo + wi);
    const Spectrum gloss = model.specular_color * (fresnel_dielectric(glm::dot(wo, h), 1.5f) * facets.d(h) *
                                                   facets.g2_reflection(wo, wi) / (4 * wo.z));
    const float rest = 1 - layer_albedo(facets, wo, 1.5f);
    expect_relative(model.eval(wo, wi), gloss + model.base_color * (rest * wi.z * kInvPi), 1e-5f);
  });
}

/// Elias & Elias 2001, "interfaced Lambertian": what the specification's darkening is made after.
TEST(OpenPbr, CoatDarkensALambertianBase) {
  OpenPbrValues v{.base_color = {0.8f, 0.5f, 0.1f}, .specular_weight = 0, .coat_weight = 1, .coat_ior = 1.5f};
  const vec3 wo(0, 0, 1);
  for (const float darkening : {1.0f, 0.0f}) {
    v.coat_darkening = darkening;
    const float k = 1 - (1 - 0.0917864f) / 2.25f; // mean reflectance of 1.5, by quadrature in double
    const Spectrum once = Spectrum(1 - k) / (Spectrum(1) - v.base_color * k);
    const float passes = 1 - layer_albedo(open_pbr::facets(0, 0), wo, 1.5f);
    EXPECT_NEAR(passes, 0.96f, 2e-3f);
    expect_relative(OpenPbr{v}.eval(wo, at_degrees(40, 1)),
                    passes * v.base_color * open_pbr::lerp(Spectrum(1), once, darkening) *
                        (std::cos(radians(40)) * kInvPi),
                    1e-3f);
  }
}

TEST(OpenPbr, FactorOfReflectanceAtNormalIncidence) {
  for (const float weight : {0.0f, 0.3f, 1.0f, 2.0f}) {
    const float eta = open_pbr::eta({.specular_weight = weight});
    EXPECT_NEAR(sqr((eta - 1) / (eta + 1)), 0.04f * weight, 1e-6);
  }
  // A coat of the base's index hides it; a denser one does not reflect totally.
  EXPECT_NEAR(open_pbr::eta({.coat_weight = 1, .coat_ior = 1.5f}), 1, 1e-6);
  EXPECT_NEAR(open_pbr::eta({.coat_weight = 1, .coat_ior = 2}), 2 / 1.5f, 1e-6);
}

TEST(OpenPbr, TablesAreNotLessThanWhatTheyAreOf) {
  std::mt19937 random(static_cast<std::uint32_t>(fresh_seed()));
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int i = 0; i < 300; ++i) {
    const float alpha = std::max(sqr(uniform(random)), 1e-3f), root = uniform(random);
    const float cosine = std::max(sqr(root), 2e-3f), eta = 1.02f + 1.98f * sqr(uniform(random));
    const Microfacets facets{MicrofacetDistribution::ggx, alpha, alpha};
    const vec3 w(std::sqrt(1 - sqr(cosine)), 0, cosine);
    double sum = 0, lossless = 0;
    constexpr int kCount = 4096;
    for (int k = 0; k < kCount; ++k) {
      const double y = k * 0.61803398874989485;
      const vec2 u((static_cast<float>(k) + 0.5f) / kCount, static_cast<float>(y - std::floor(y)));
      const vec3 h = facets.sample_visible_normal(w, sample_uniform_disc(u));
      const vec3 wi = 2 * glm::dot(w, h) * h - w;
      if (!(wi.z > 0)) continue;
      const double g = double(facets.g2_reflection(w, wi) / facets.g1(w));
      lossless += g, sum += g * double(fresnel_dielectric(glm::dot(w, h), eta));
    }
    sum /= kCount, lossless /= kCount;
    const double used = double(layer_albedo(facets, w, eta));
    EXPECT_GE(used, sum - 5e-5) << alpha << ' ' << cosine << ' ' << eta;
    EXPECT_LE(used, sum + 0.04) << alpha << ' ' << cosine << ' ' << eta;
    EXPECT_GE(double(lossless_share(facets, w)), lossless - 5e-4) << alpha << ' ' << cosine;
    const double nodes = double(
        ReflectedShares::albedo(facets, w, [&](float c) { return Spectrum(fresnel_dielectric(c, eta)); }).x);
    EXPECT_GE(nodes, sum - 5e-5) << alpha << ' ' << cosine << ' ' << eta;
    EXPECT_LE(nodes, sum + 0.07) << alpha << ' ' << cosine << ' ' << eta;
  }
}

TEST(OpenPbr, WhiteFurnace) {
  for (int i = 0; const auto& [v, loss] : whites()) {
    const OpenPbr model{v};
    const double rough = double(sqr(v.coat_weight > 0 ? v.coat_roughness : v.specular_roughness));
    for (const float cosine : {1.0f, 0.3f, 0.05f}) {
      const vec3 wo(std::sqrt(1 - sqr(cosine)), 0, cosine);
      const auto value = [&](vec3 wi) { return double(model.eval(wo, wi, TransportMode::importance).x); };
      const auto part = [&](float side, vec3 peak) {
        return integrate_sphere([&](vec3 wi) { return wi.z * side > 0 ? value(wi) : 0; }, peak, 2 * rough);
      };
      double sum = part(1, reflect_about_normal(wo));
      if (v.transmission_weight > 0) sum += part(-1, *refract(wo, open_pbr::eta(v)));
      EXPECT_LE(sum, 1 + 1e-4) << i << ' ' << cosine;
      EXPECT_GE(sum, 1 - double(loss)) << i << ' ' << cosine;
    }
    ++i;
  }
}

/// Random values, of which every other is an extreme one.
TEST(OpenPbr, NeverGivesMoreThanItGot) {
  std::mt19937 random(static_cast<std::uint32_t>(fresh_seed()));
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto any = [&] {
    const float kind = uniform(random), x = uniform(random);
    return kind < 0.25f ? 0 : kind < 0.5f ? 1 : x;
  };
  for (int i = 0; i < 60; ++i) {
    OpenPbrValues v{.base_color = Spectrum(any() > 0.5f ? 1.0f : any()),
                    .base_diffuse_roughness = any(),
                    .base_metalness = any(),
                    .specular_weight = 2 * any(),
                    .specular_color = Spectrum(1),
                    .specular_roughness = 0.2f + 0.8f * any(),
                    .specular_roughness_anisotropy = any() * any(),
                    .specular_ior = 1 + 2 * any(),
                    .transmission_weight = any(),
                    .coat_weight = any(),
                    .coat_roughness = 0.2f + 0.8f * any(),
                    .coat_roughness_anisotropy = any() * any(),
                    .coat_ior = 1 + 2 * any(),
                    .coat_darkening = any(),
                    .fuzz_weight = any(),
                    .fuzz_roughness = any(),
                    .thin_film_weight = any(),
                    .thin_film_thickness = any(),
                    .thin_film_ior = 1 + 2 * any()};
    for (const float cosine : {1.0f, 0.5f, 0.1f, 0.01f, -0.02f, -0.4f, -0.9f}) {
      // All that is scattered, by samples; six standard deviations are allowed. Weights that are alike but
      // for rare losses have a spread that few samples do not show: an excess counts if many have it, too.
      const vec3 wo(std::sqrt(1 - sqr(cosine)), 0, cosine);
      const auto excess = [&](int samples) {
        double most = 0;
        for (const auto& channel : albedo_by_samples(tested("random", OpenPbr{v}), wo, samples).channel)
          most = std::max(most, channel.mean() - 1 - 1e-4 - 6 * std::sqrt(channel.variance_of_mean()));
        return most;
      };
      if (excess(1000) > 0) { EXPECT_EQ(excess(200000), 0) << i << ' ' << cosine; }
    }
  }
}

TEST(OpenPbr, BothSidesAreAlikeWithoutGlass) {
  const OpenPbr model{{.base_metalness = 0.3f, .coat_weight = 0.5f, .fuzz_weight = 0.5f}};
  for_pairs([&](vec3 wo, vec3 wi) {
    expect_relative(model.eval({wo.x, wo.y, -wo.z}, {wi.x, wi.y, -wi.z}), model.eval(wo, wi), 1e-6f);
  });
}

TEST(OpenPbr, RefractionIsReciprocal) {
  // The layers' scaling is not, but for what passes through all of them.
  const OpenPbr model{{.base_color = Spectrum(0),
                       .specular_roughness = 0.5f,
                       .transmission_weight = 1,
                       .coat_weight = 0.7f,
                       .coat_color = {0.9f, 0.5f, 0.2f},
                       .coat_roughness = 0.3f,
                       .fuzz_weight = 0.6f,
                       .thin_film_weight = 1}};
  const float eta = open_pbr::eta(model);
  for_pairs([&](vec3 wo, vec3 wi) {
    wi = -wi;
    expect_relative(model.eval(wo, wi) / std::abs(wi.z) * sqr(eta), model.eval(wi, wo) / std::abs(wo.z),
                    1e-4f);
  });
}

TEST(OpenPbr, SamplesAgree) {
  for (const TestedBsdf& model : open_pbr_models()) expect_samples_agree(model);
}

TEST(OpenPbrStatistical, DirectionsFollowThePdf) {
  const vec3 directions[] = {at_degrees(20, 0.3f), at_degrees(75, -1), at_degrees(89.9f, 0.5f),
                             at_degrees(120, 1)};
  const auto all = open_pbr_models();
  for (const TestedBsdf& model : all)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(all.size() * std::size(directions)), 10000);
}

TEST(OpenPbrStatistical, SampledAlbedoIsThatOfTheValues) {
  const auto all = open_pbr_models();
  const std::size_t tried[] = {0, 2, 4};
  for (const std::size_t i : tried)
    for (const vec3 wo : {at_degrees(40, 1), at_degrees(110, 2)}) {
      const SampledAlbedo sampled = albedo_by_samples(all[i], wo, 20000);
      const vec3 exact = albedo_by_quadrature(all[i], wo);
      for (int c = 0; c < 3; ++c)
        EXPECT_GT(z_test(sampled.channel[c], double(exact[c]), 1e-3), sidak_threshold(18))
            << i << ": " << sampled.channel[c].mean() << " for " << exact[c];
    }
}

} // namespace
} // namespace candela::test
