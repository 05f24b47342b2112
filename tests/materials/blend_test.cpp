// Mixtures of closures.

#include "materials/blend_parts.h"
#include "materials/delta_lobes.h"
#include "support/bsdf_contract.h"
#include "support/patterns.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace candela::test {
namespace {

/// Kept to the end of the program.
Blend blend_of(std::vector<BlendPart> parts) {
  static std::deque<std::vector<BlendPart>> kept;
  auto& own = kept.emplace_back(std::move(parts));
  return {own.data(), static_cast<std::uint32_t>(own.size())};
}

RoughDielectric frosted(float alpha) {
  RoughDielectric bsdf;
  bsdf.facets.alpha_x = bsdf.facets.alpha_y = alpha;
  return bsdf;
}
Turned<Conductor> brushed() {
  Conductor bsdf;
  bsdf.smooth = false;
  bsdf.facets = {MicrofacetDistribution::ggx, 0.5f, 0.15f};
  return {bsdf};
}

struct Case {
  std::string name;
  std::vector<BlendPart> parts;
};
std::vector<Case> cases() {
  const Spectrum orange(0.6f, 0.3f, 0.1f);
  return {
      {"matte and gloss", {{Diffuse{orange}, 0.3f}, {Ggx{Spectrum(0.9f), 0.3f}, 0.7f}}},
      {"black and matte", {{Diffuse{Spectrum(0)}, 0.5f}, {Diffuse{orange}, 0.5f}}},
      {"black and gloss", {{Diffuse{Spectrum(0)}, 0.25f}, {Ggx{Spectrum(0.8f), 0.4f}, 0.75f}}},
      {"gloss and nothing", {{Ggx{Spectrum(0.8f), 0.4f}, 0.6f}, {Blend(), 0.4f}}},
      {"matte and coat", {{Diffuse{orange}, 0.4f}, {Plastic{}, 0.6f}}},
      {"mirror and matte", {{Mirror{Spectrum(0.9f), Spectrum(0)}, 0.35f}, {Diffuse{orange}, 0.65f}}},
      {"glass and mirror", {{Dielectric{1.5f, Spectrum(1)}, 0.5f}, {Mirror{orange, Spectrum(0)}, 0.5f}}},
      {"glass and matte", {{Dielectric{1.5f, Spectrum(1)}, 0.8f}, {Diffuse{orange}, 0.2f}}},
      {"frosted and matte", {{frosted(0.4f), 0.5f}, {Diffuse{orange}, 0.5f}}},
      {"brushed and matte", {{brushed(), 0.5f}, {Diffuse{orange}, 0.5f}}},
      {"three", {{Diffuse{orange}, 0.2f}, {Ggx{Spectrum(0.9f), 0.2f}, 0.3f}, {Plastic{}, 0.5f}}},
      {"nested",
       {{Bsdf(blend_of({{Diffuse{orange}, 0.5f}, {Plastic{}, 0.5f}})), 0.6f}, {frosted(0.3f), 0.4f}}},
  };
}
TestedBsdf tested_case(const Case& c) { return tested(c.name, blend_of(c.parts), 2, 1.5f); }

TEST(Blend, SamplesAgree) {
  for (const Case& c : cases()) expect_samples_agree(tested_case(c));
}

TEST(Blend, DirectionsFollowTheDensity) {
  const auto directions = contract_directions();
  const std::vector<Case> all = cases();
  const int count = static_cast<int>(all.size() * directions.size());
  for (const Case& c : all)
    for (const vec3& wo : directions) expect_directions_follow_pdf(tested_case(c), wo, count);
}

TEST(Blend, Reciprocity) {
  for (const Case& c : cases()) expect_reciprocal(tested_case(c), 5000);
}

TEST(Blend, ConservesEnergy) {
  const std::vector<Case> all = cases();
  for (const Case& c : all) expect_conserves_energy(tested_case(c), static_cast<int>(all.size()));
}

TEST(Blend, IsTheSumOfItsParts) {
  Random random(static_cast<std::uint32_t>(fresh_seed()));
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Blend blend = blend_of(c.parts);
    Spectrum albedo(0);
    for (const BlendPart& part : c.parts) albedo += part.weight * bsdf_albedo(part.bsdf);
    EXPECT_LT(glm::length(blend.albedo() - albedo), 1e-6f);
    for (int i = 0; i < 200; ++i) {
      const vec3 wo = glm::normalize(vec3(random.in_square(1), random() - 0.3f)),
                 wi = glm::normalize(vec3(random.in_square(1), random() - 0.3f));
      vec3 f(0);
      float pdf = 0, delta = 0, lobe = 0;
      for (const BlendPart& part : c.parts) {
        const BsdfEval e = bsdf_eval_pdf(part.bsdf, wo, wi, TransportMode::radiance);
        f += part.weight * e.f_cos, pdf += part.weight * e.pdf;
        delta += part.weight * bsdf_delta_probability(part.bsdf, wo);
        lobe += part.weight * bsdf_lobe_proxy(part.bsdf, wo).lobe_albedo();
      }
      const BsdfEval e = blend.eval_pdf(wo, wi);
      EXPECT_NEAR(e.pdf, pdf, 1e-6f * std::max(pdf, 1.0f));
      EXPECT_LT(glm::length(e.f_cos - f), 1e-6f * std::max(glm::length(f), 1.0f));
      EXPECT_LT(glm::length(blend.eval(wo, wi) - f), 1e-6f * std::max(glm::length(f), 1.0f));
      EXPECT_NEAR(blend.pdf(wo, wi), pdf, 1e-6f * std::max(pdf, 1.0f));
      EXPECT_NEAR(blend.delta_probability(wo), delta, 1e-6f);
      EXPECT_NEAR(blend.lobe_proxy(wo).lobe_albedo(), lobe, 1e-4f * std::max(lobe, 1.0f));
    }
  }
}

/// The mean of the samples is the sum of the means: no part's light is lost where another one has none.
TEST(Blend, LosesNoLightOfAnyPart) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const vec3 wo = glm::normalize(vec3(0.5f, 0.2f, 0.7f));
    const SampledAlbedo mixed = albedo_by_samples(tested_case(c), wo, 200000);
    vec3 expected(0);
    double variance[3] = {0, 0, 0};
    for (const BlendPart& part : c.parts) {
      const Bsdf bsdf = part.bsdf;
      const TestedBsdf own = visit_variant([](const auto& x) { return tested("part", x); }, bsdf);
      const SampledAlbedo alone = albedo_by_samples(own, wo, 200000);
      for (int i = 0; i < 3; ++i) {
        expected[i] += part.weight * static_cast<float>(alone.channel[i].mean());
        variance[i] += sqr(static_cast<double>(part.weight)) * alone.channel[i].variance_of_mean();
      }
    }
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(mixed.channel[i].mean(), static_cast<double>(expected[i]),
                  6 * std::sqrt(variance[i] + mixed.channel[i].variance_of_mean()) + 1e-6);
  }
}

TEST(Blend, AllDeltaLobesAreFollowed) {
  const vec3 wo = glm::normalize(vec3(0.5f, 0.2f, 0.7f));
  // Two glasses: one reflection, two refractions.
  const Bsdf glasses =
      blend_of({{Dielectric{1.5f, Spectrum(1)}, 0.4f}, {Dielectric{2, Spectrum(0.9f)}, 0.6f}});
  const DeltaLobes lobes = delta_lobes(glasses, wo);
  ASSERT_EQ(lobes.count, 3);
  double sum[2] = {0, 0}, sampled[2] = {0, 0};
  for (int i = 0; i < lobes.count; ++i) {
    const DeltaLobe& lobe = lobes.lobe[static_cast<std::size_t>(i)];
    sum[same_hemisphere(wo, lobe.wi)] += static_cast<double>(lobe.transfer.x);
  }
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const auto s = bsdf_sample(glasses, wo, vec3(0.3f, 0.6f, (static_cast<float>(i) + 0.5f) / kSteps));
    ASSERT_TRUE(s && s->delta);
    sampled[same_hemisphere(wo, s->wi)] += static_cast<double>(s->weight.x) / kSteps;
    if (same_hemisphere(wo, s->wi)) continue; // which both glasses have
    const auto lobe = std::ranges::find(lobes.lobe, s->wi, &DeltaLobe::wi);
    ASSERT_NE(lobe, lobes.lobe.end());
    EXPECT_NEAR(s->weight.x * s->pdf, lobe->transfer.x, 1e-5f) << "the probability is that of the lobe";
  }
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(sum[i], sampled[i], 1e-3);
  EXPECT_EQ(delta_lobes(blend_of({{Diffuse{}, 0.5f}, {Ggx{}, 0.5f}}), wo).count, 0);
}

TEST(Blend, TurnsAnisotropicParts) {
  Blend blend = blend_of({{brushed(), 0.5f}, {Diffuse{Spectrum(0)}, 0.5f}});
  Bsdf whole = blend, part = brushed();
  ASSERT_TRUE(is_anisotropic(whole));
  EXPECT_TRUE(has_tangent(whole));
  set_tangent(whole, vec2(1, 2));
  set_tangent(part, vec2(1, 2));
  const vec3 wo = glm::normalize(vec3(0.5f, 0.2f, 0.7f)), wi = glm::normalize(vec3(-0.1f, -0.3f, 0.7f));
  EXPECT_NEAR(bsdf_eval(whole, wo, wi).x, 0.5f * bsdf_eval(part, wo, wi).x, 1e-6f);
  EXPECT_FALSE(is_anisotropic(Bsdf(blend_of({{Diffuse{}, 0.5f}, {Ggx{}, 0.5f}}))));
}

TEST(Blend, AsksForTheLobesNumberEvenOfLambertianParts) {
  const Blend blend = blend_of({{Diffuse{}, 0.5f}, {Diffuse{}, 0.5f}});
  EXPECT_TRUE(chooses_lobe(blend.flags()));
  EXPECT_TRUE(is_diffuse(blend.flags()));
  EXPECT_FALSE(chooses_lobe(Diffuse{}.flags()));
}

TEST(Blend, ClosuresStaySmall) { EXPECT_LE(sizeof(Bsdf), 144u); }

} // namespace
} // namespace candela::test
