#include "materials/delta_lobes.h"
#include "support/seed.h"

#include <gtest/gtest.h>

namespace {

using namespace candela;

/// What sampling gives in the mean, by midpoints of the lobe's number: of the delta lobes on each side.
struct Sides {
  vec3 reflected{0}, refracted{0};
};
Sides by_sampling(const Bsdf& bsdf, vec3 wo) {
  Sides s;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    auto sample = bsdf_sample(bsdf, wo, vec3(0.3f, 0.6f, (static_cast<float>(i) + 0.5f) / kSteps));
    if (!sample || !sample->delta) continue;
    (same_hemisphere(wo, sample->wi) ? s.reflected : s.refracted) += sample->weight / float{kSteps};
  }
  return s;
}

void expect_lobes(const Bsdf& bsdf, vec3 wo) {
  Sides expected = by_sampling(bsdf, wo), whole;
  DeltaLobes lobes = delta_lobes(bsdf, wo);
  for (int i = 0; i < lobes.count; ++i) {
    const DeltaLobe& lobe = lobes.lobe[static_cast<std::size_t>(i)];
    EXPECT_NEAR(glm::length(lobe.wi), 1, 1e-5f);
    (same_hemisphere(wo, lobe.wi) ? whole.reflected : whole.refracted) += lobe.transfer;
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(whole.reflected[c], expected.reflected[c], 2e-3f);
    EXPECT_NEAR(whole.refracted[c], expected.refracted[c], 2e-3f);
  }
}

TEST(DeltaLobes, AreWhatSamplingGivesInTheMean) {
  for (vec3 wo : {glm::normalize(vec3(0.3f, -0.2f, 0.8f)), glm::normalize(vec3(0.9f, 0.1f, 0.2f)),
                  glm::normalize(vec3(0.2f, 0.1f, -0.7f)), glm::normalize(vec3(-0.8f, 0.5f, -0.1f))}) {
    expect_lobes(Diffuse{vec3(0.5f)}, wo);
    expect_lobes(Ggx{vec3(0.9f), 0.3f}, wo);
    expect_lobes(Mirror{{0.9f, 0.5f, 0.1f}, vec3(0)}, wo);
    expect_lobes(Mirror{{0.4f, 0.5f, 0.1f}, {0.3f, 0.2f, 0.1f}}, wo);
    expect_lobes(Mirror{vec3(0), {0.3f, 0.2f, 0.1f}}, wo);
    expect_lobes(Dielectric{1.5f, {0.9f, 0.8f, 0.7f}}, wo);
    expect_lobes(Dielectric{1.0f, vec3(1)}, wo); // nothing is reflected
    expect_lobes(Dielectric{1.5f, vec3(0)}, wo); // nothing goes through
  }
}

TEST(DeltaLobes, TellHowTheIndexChanges) {
  DeltaLobes in = delta_lobes(Dielectric{1.5f, vec3(1)}, {0, 0, 1});
  ASSERT_EQ(in.count, 2);
  EXPECT_FLOAT_EQ(in.lobe[0].eta, 1);
  EXPECT_FLOAT_EQ(in.lobe[1].eta, 1.5f);
}

} // namespace
