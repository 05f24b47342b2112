// Disney's model, against Mitsuba's numbers and the contract.

#include "materials/principled_material.h"
#include "principled_reference.h"
#include "support/bsdf_contract.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace candela::test {
namespace {

vec3 direction(const float (&degrees)[2]) {
  const float theta = radians(degrees[0]), phi = radians(degrees[1]);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Principled closure_of(const PrincipledMaterial& material) {
  struct Constants {
    float operator()(const NumberParameter& p) const { return p.value; }
    Spectrum operator()(const ColorParameter& p) const { return p.value; }
  };
  return material.closure(Constants()).closure;
}

void expect_near(vec3 value, vec3 expected, float relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], relative * std::max(expected[c], 1e-6f));
}

std::vector<TestedBsdf> principled_models() {
  std::vector<TestedBsdf> all;
  const auto add = [&](PrincipledValues v) {
    // Of the narrowest lobe of any weight.
    const double alpha = v.clearcoat > 0 ? 0.1 : std::max(double(sqr(v.roughness)), 1e-3);
    all.push_back(tested(fmt::format("{} {}", v.thin ? "sheet" : "solid", all.size()), Principled{v},
                         std::min(2.0, 2 * alpha), v.thin ? 1 : v.eta));
  };
  for (const PrincipledValues& v : reference_solids()) add(v);
  for (const PrincipledValues& v : reference_sheets()) add(v);
  // Extremes.
  add({.base_color = Spectrum(0), .roughness = 0, .eta = 1});
  add({.base_color = Spectrum(1), .roughness = 1, .spec_trans = 1, .eta = 3, .spec_tint = 1});
  add({.base_color = {0, 0, 1},
       .roughness = 1,
       .anisotropic = -1,
       .metallic = 0.5f,
       .spec_trans = 0.5f,
       .eta = 1.02f,
       .spec_tint = 1,
       .sheen = 1,
       .sheen_tint = 1,
       .flatness = 1,
       .clearcoat = 1});
  add({.base_color = Spectrum(1), .roughness = 1, .spec_trans = 1, .eta = 3, .spec_tint = 1, .thin = true});
  add({.base_color = Spectrum(0), .roughness = 1, .eta = 1, .clearcoat = 1}); // the coat alone
  return all;
}

TEST(Principled, AsMitsuba) {
  const auto solids = reference_solids();
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (std::size_t k = 0; k < std::size(kReferencePairs); ++k) {
      SCOPED_TRACE(fmt::format("solid {} pair {}", i, k));
      const auto& [wo, wi] = kReferencePairs[k];
      const Principled model{solids[i]};
      const float(&known)[3] = kMitsubaSolids[i][k];
      // Inside, Mitsuba leaves the opaque share black.
      const bool inside = wo[0] > 90, reflects = (wi[0] > 90) == inside;
      const float opaque = 1 - (1 - model.metallic) * model.spec_trans;
      if (inside && reflects && opaque > 0) continue;
      expect_near(model.eval(direction(wo), direction(wi)), {known[0], known[1], known[2]}, 1e-4f);
    }
}

TEST(PrincipledThin, AsMitsuba) {
  const auto sheets = reference_sheets();
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t k = 0; k < std::size(kReferencePairs); ++k) {
      SCOPED_TRACE(fmt::format("sheet {} pair {}", i, k));
      const auto& [wo, wi] = kReferencePairs[k];
      const float(&known)[3] = kMitsubaSheets[i][k];
      expect_near(Principled{sheets[i]}.eval(direction(wo), direction(wi)), {known[0], known[1], known[2]},
                  1e-4f);
    }
}

TEST(Principled, InsideIsGlassAndTheMirroredRest) {
  const PrincipledValues v{.base_color = {0.6f, 0.7f, 0.2f},
                           .roughness = 0.3f,
                           .metallic = 0.3f,
                           .spec_trans = 0.4f,
                           .eta = 1.33f,
                           .spec_tint = 0.5f,
                           .sheen = 0.6f,
                           .flatness = 0.5f,
                           .clearcoat = 1,
                           .clearcoat_gloss = 0.9f};
  const float share = (1 - v.metallic) * v.spec_trans;
  PrincipledValues glass = v, rest = v;
  glass.metallic = 0, glass.spec_trans = 1;
  rest.metallic = v.metallic / (1 - share), rest.spec_trans = 0;
  const float angles[][2] = {{30, 0}, {70, 100}, {85, 200}, {40, 190}};
  for (const auto& a : angles)
    for (const auto& b : angles) {
      const vec3 wo = direction(a), wi = direction(b);
      expect_near(Principled{v}.eval(-wo, -wi),
                  share * Principled{glass}.eval(-wo, -wi) +
                      (1 - share) * Principled{rest}.eval({-wo.x, -wo.y, wo.z}, {-wi.x, -wi.y, wi.z}),
                  1e-4f);
      // Without glass both sides are alike.
      expect_near(Principled{rest}.eval({wo.x, wo.y, -wo.z}, {wi.x, wi.y, -wi.z}),
                  Principled{rest}.eval(wo, wi), 1e-5f);
    }
}

TEST(PrincipledMaterial, IndexOfRefraction) {
  PrincipledMaterial material;
  EXPECT_NEAR(closure_of(material).eta, 1.5f, 1e-6);
  material.specular = 0.0f;
  EXPECT_EQ(closure_of(material).eta, 1);
  material.spec_trans = 1.0f;
  EXPECT_GT(closure_of(material).eta, 1);
  material.eta = 1.33f;
  EXPECT_EQ(closure_of(material).eta, 1.33f);
}

TEST(Principled, SamplesAgree) {
  for (const TestedBsdf& model : principled_models()) expect_samples_agree(model);
}

TEST(Principled, Reciprocity) {
  // The half vector of a refraction is a difference of nearly equal directions: fewer digits.
  for (const TestedBsdf& model : principled_models())
    expect_reciprocal(model, 10000,
                      !has_any(model.flags, BsdfFlags::transmission) ? 1e-5f
                      : model.ior == 1.02f                           ? 1e-3f
                                                                     : 1e-4f);
}

TEST(Principled, GlassAndMetalConserveEnergy) {
  const auto solids = reference_solids();
  for (const std::size_t i : {3, 5})
    expect_conserves_energy(tested(fmt::format("solid {}", i), Principled{solids[i]}, 0.2, solids[i].eta),
                            10);
}

/// As much as principled.h says, and no more.
TEST(Principled, BoundOfAlbedo) {
  const auto albedo = [](PrincipledValues v, float cosine) {
    return max_component(
        albedo_by_quadrature(tested("white", Principled{v}, 1), {std::sqrt(1 - sqr(cosine)), 0, cosine}));
  };
  for (const float cosine : {1.0f, 0.7f, 0.4f, 0.2f, 0.1f, 0.03f}) {
    const PrincipledValues smooth{.base_color = Spectrum(1), .roughness = 0, .eta = 1};
    PrincipledValues rough = smooth, all = smooth;
    rough.roughness = 1;
    all.roughness = 1, all.eta = 1.8f, all.sheen = 1, all.clearcoat = 1;
    EXPECT_LE(albedo(smooth, cosine), 1);
    EXPECT_LE(albedo(rough, cosine), 1.52f);
    EXPECT_LE(albedo(all, cosine), 1.7f);
    if (cosine < 0.05f) { EXPECT_GT(albedo(rough, cosine), 1.4f); }
  }
}

TEST(PrincipledStatistical, DirectionsFollowThePdf) {
  const auto all = principled_models();
  const auto directions = contract_directions();
  for (const TestedBsdf& model : all)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(model, wo, static_cast<int>(all.size() * directions.size()), 10000);
}

TEST(PrincipledStatistical, SampledAlbedoIsThatOfTheValues) {
  const auto all = principled_models();
  const float directions[][2] = {{30, 1}, {80, 2}, {130, 0.5f}};
  for (const TestedBsdf& model : all)
    for (const auto& d : directions) {
      const vec3 wo = direction(d);
      SampledAlbedo sampled = albedo_by_samples(model, wo, 10000);
      const vec3 exact = albedo_by_quadrature(model, wo);
      for (int c = 0; c < 3; ++c) {
        // A run with few of the rare samples that carry much is surer of its mean than it should be.
        for (int i = 0; i < 6; ++i) sampled.channel[c].add(0), sampled.channel[c].add(2 * double(exact[c]));
        EXPECT_GT(z_test(sampled.channel[c], double(exact[c]), 1e-3),
                  sidak_threshold(9 * static_cast<int>(all.size())))
            << model.name << " wo.z " << wo.z << ": " << sampled.channel[c].mean() << " for " << exact[c];
      }
    }
}

} // namespace
} // namespace candela::test
