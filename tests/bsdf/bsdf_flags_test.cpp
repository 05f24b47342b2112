// The flags of models against their behaviour.

#include "bsdf/bsdf_test_models.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

TEST(BsdfFlags, AreWhatTheModelDoes) {
  std::vector<NamedBsdf> models = glossy_models();
  models.push_back({"mirror", Mirror{vec3(0.9f), vec3(0)}, 2});
  models.push_back({"glass", Dielectric{1.5f, vec3(0.9f)}, 2});
  models.push_back({"opaque glass", Dielectric{1.5f, vec3(0)}, 2});
  RandomNumbers random(7);
  for (const NamedBsdf& m : models) {
    SCOPED_TRACE(m.name);
    const BsdfFlags flags = bsdf_flags(m.bsdf);
    BsdfFlags seen = BsdfFlags::none;
    bool has_density = false;
    for (int i = 0; i < 4000; ++i) {
      const vec3 wo = random.direction();
      const auto s = bsdf_sample(m.bsdf, wo, random.three());
      if (!s) continue;
      seen |= same_hemisphere(wo, s->wi) ? BsdfFlags::reflection : BsdfFlags::transmission;
      if (s->delta) seen |= BsdfFlags::delta;
      has_density |= !s->delta;
    }
    // Each of these that happens is said, and what is said happens (but for what is black).
    for (BsdfFlags f : {BsdfFlags::reflection, BsdfFlags::delta})
      EXPECT_EQ(has_any(flags, f), has_any(seen, f));
    if (has_any(seen, BsdfFlags::transmission)) { EXPECT_TRUE(has_any(flags, BsdfFlags::transmission)); }
    EXPECT_EQ(has_any(flags, BsdfFlags::diffuse | BsdfFlags::glossy), has_density);
    EXPECT_EQ(is_diffuse(flags), std::holds_alternative<Diffuse>(m.bsdf));
  }
  EXPECT_FALSE(has_any(bsdf_flags(Diffuse{}), BsdfFlags::transmission));
  EXPECT_TRUE(has_any(bsdf_flags(Dielectric{}), BsdfFlags::transmission));
  EXPECT_FALSE(transmits_with_density(bsdf_flags(Dielectric{}))) << "its refraction is delta";
  EXPECT_TRUE(transmits_with_density(BsdfFlags::reflection | BsdfFlags::transmission | BsdfFlags::glossy));
}

TEST(TransportMode, RefractionScalesRadianceAlone) {
  const Bsdf glass = Dielectric{1.5f, {0.9f, 0.8f, 0.7f}};
  const BsdfU refracts(vec3(0.3f, 0.4f, 0.999f));
  for (float z : {0.8f, -0.9f}) {
    const vec3 wo(std::sqrt(1 - z * z), 0, z);
    const auto radiance = bsdf_sample(glass, wo, refracts),
               importance = bsdf_sample(glass, wo, refracts, TransportMode::importance);
    ASSERT_TRUE(radiance && importance);
    EXPECT_EQ(importance->wi, radiance->wi);
    EXPECT_EQ(importance->weight, (Spectrum{0.9f, 0.8f, 0.7f}));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(radiance->weight[c] * sqr(radiance->eta), importance->weight[c], 1e-6f);
  }
  const Bsdf diffuse = Diffuse{vec3(0.5f)};
  const vec3 wo(0.6f, 0, 0.8f), wi(0, 0.6f, 0.8f);
  EXPECT_EQ(bsdf_eval(diffuse, wo, wi, TransportMode::importance), bsdf_eval(diffuse, wo, wi));
}

} // namespace
} // namespace candela::test
