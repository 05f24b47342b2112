#include "bsdf/bsdf_test_models.h"
#include "bsdf/dielectric.h"
#include "bsdf/mirror.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

TEST(Fresnel, NormalIncidence) {
  for (float n : {1.0f, 1.33f, 1.5f, 2.4f, 1 / 1.5f}) {
    double r = (double(n) - 1) / (double(n) + 1);
    EXPECT_NEAR(fresnel_dielectric(1, n), r * r, 1e-7) << n;
  }
}

TEST(Fresnel, GrazingIncidenceReflectsAll) {
  for (float n : {1.1f, 1.5f, 2.4f, 0.7f}) EXPECT_NEAR(fresnel_dielectric(0, n), 1, 1e-6) << n;
  EXPECT_EQ(fresnel_dielectric(0.5f, 1), 0);
}

TEST(Fresnel, BrewstersAngleReflectsOnePolarisationOnly) {
  for (double n : {1.33, 1.5, 2.4}) {
    double theta = std::atan(n), theta_t = std::asin(std::sin(theta) / n);
    double r_s = std::sin(theta - theta_t) / std::sin(theta + theta_t); // Fresnel's sine law
    EXPECT_NEAR(fresnel_dielectric(static_cast<float>(std::cos(theta)), static_cast<float>(n)),
                0.5 * r_s * r_s, 1e-6);
  }
}

TEST(Fresnel, SineAndTangentLaws) {
  for (double n : {1.2, 1.5, 2.4, 0.6}) {
    for (double theta = 0.05; theta < 1.55; theta += 0.05) {
      if (std::sin(theta) / n >= 0.999) continue;
      double t = std::asin(std::sin(theta) / n);
      double r_s = std::sin(theta - t) / std::sin(theta + t), r_p = std::tan(theta - t) / std::tan(theta + t);
      EXPECT_NEAR(fresnel_dielectric(static_cast<float>(std::cos(theta)), static_cast<float>(n)),
                  0.5 * (r_s * r_s + r_p * r_p), 2e-5)
          << n << ' ' << theta;
    }
  }
}

TEST(Fresnel, TotalReflectionFromTheCriticalAngle) {
  double critical = std::asin(1 / 1.5);
  for (double beyond : {1e-4, 0.1, 0.5}) {
    auto cosine = static_cast<float>(std::cos(critical + beyond));
    EXPECT_EQ(fresnel_dielectric(cosine, 1 / 1.5f), 1);
    EXPECT_FALSE(refract(direction(static_cast<float>(critical + beyond), 1), 1 / 1.5f));
    auto below = static_cast<float>(critical - beyond);
    EXPECT_LT(fresnel_dielectric(std::cos(below), 1 / 1.5f), 1);
    EXPECT_TRUE(refract(direction(below, 1), 1 / 1.5f));
  }
}

TEST(Fresnel, TheSameFromBothSides) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(1);
  for (int i = 0; i < 1000; ++i) {
    vec3 wo = random.direction();
    float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    std::optional<vec3> wi = refract(wo, eta);
    if (!wi || std::abs(wi->z) < 0.1f || std::abs(wo.z) < 0.1f) continue; // where cosines keep their digits
    EXPECT_NEAR(fresnel_dielectric(std::abs(wo.z), eta), fresnel_dielectric(std::abs(wi->z), 1 / eta), 1e-4);
  }
}

TEST(Fresnel, SchlickAtItsEnds) {
  vec3 f0(0.9f, 0.5f, 0.04f);
  EXPECT_EQ(fresnel_schlick(f0, 1), f0);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(fresnel_schlick(f0, 0)[c], 1);
  EXPECT_NEAR(fresnel_schlick(f0, 0.5f).z, 0.04 + 0.96 / 32, 1e-6);
}

TEST(Refraction, SnellsLawInOnePlane) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(2);
  for (int i = 0; i < 2000; ++i) {
    vec3 wo = random.direction();
    float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    std::optional<vec3> wi = refract(wo, eta);
    double sin_o = std::hypot(double(wo.x), double(wo.y));
    if (!wi) {
      EXPECT_GE(sin_o, double(eta) - 1e-5);
      continue;
    }
    EXPECT_NEAR(glm::length(*wi), 1, 1e-5);
    EXPECT_LE(wi->z * wo.z, 0);
    EXPECT_NEAR(double(eta) * std::hypot(double(wi->x), double(wi->y)), sin_o, 1e-6);
    EXPECT_NEAR(double(wo.x) * double(wi->y) - double(wo.y) * double(wi->x), 0,
                1e-6);                                                         // in the plane of incidence
    EXPECT_LE(double(wo.x) * double(wi->x) + double(wo.y) * double(wi->y), 0); // and across the normal
    // And back again.
    std::optional<vec3> back = refract(*wi, 1 / eta);
    if (back && std::abs(wi->z) > 0.05f && std::abs(wo.z) > 0.05f) {
      EXPECT_LT(glm::length(*back - wo), 1e-4f);
    }
  }
}

TEST(Dielectric, LosesNoLight) {
  SCOPED_TRACE(seed_note());
  // R + T = 1: with eta^2 taken out of the refracted radiance, what comes from a sky of 1 is 1, for every
  // sample.
  RandomNumbers random(3);
  Dielectric glass{1.5f, vec3(1)};
  int reflected = 0, refracted = 0;
  for (int i = 0; i < 5000; ++i) {
    vec3 wo = random.direction(), u = random.three();
    std::optional<BsdfSample> s = glass.sample(wo, u);
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->delta);
    float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    float r = fresnel_dielectric(std::abs(wo.z), eta);
    bool same_side = s->wi.z * wo.z > 0;
    (same_side ? reflected : refracted) += 1;
    EXPECT_EQ(s->eta, same_side ? 1.0f : eta);
    EXPECT_NEAR(s->weight.x * sqr(s->eta), 1, 1e-6);
    EXPECT_NEAR(s->pdf, same_side ? r : 1 - r, 1e-6);
    if (same_side) { EXPECT_EQ(s->wi, vec3(-wo.x, -wo.y, wo.z)); }
  }
  EXPECT_GT(reflected, 500);
  EXPECT_GT(refracted, 500);
}

TEST(Dielectric, RadianceIsScaledOnTheWayIn) {
  // Looking into glass from air at the normal: radiance from inside is spread over more solid angle outside.
  Dielectric glass{1.5f, vec3(0.8f, 1, 1)};
  std::optional<BsdfSample> out = glass.sample({0, 0, 1}, vec3(0.5f, 0.5f, 0.999f));
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->weight.y, 1 / 2.25, 1e-6);
  EXPECT_NEAR(out->weight.x, 0.8 / 2.25, 1e-6);
  std::optional<BsdfSample> in = glass.sample({0, 0, -1}, vec3(0.5f, 0.5f, 0.999f));
  ASSERT_TRUE(in);
  EXPECT_NEAR(in->weight.y, 2.25, 1e-6);
  EXPECT_EQ(in->wi, vec3(0, 0, 1));
  // In and out again: the scales cancel.
  EXPECT_NEAR(out->weight.y * in->weight.y, 1, 1e-6);
}

TEST(Dielectric, EqualIndicesAreNoSurface) {
  RandomNumbers random(4);
  for (int i = 0; i < 100; ++i) {
    vec3 wo = random.direction();
    std::optional<BsdfSample> s = Dielectric{1, vec3(1)}.sample(wo, random.three());
    ASSERT_TRUE(s);
    // The square root costs a small cosine half of its digits.
    EXPECT_LT(glm::length(s->wi + wo), 5e-4f);
    EXPECT_EQ(s->weight, vec3(1));
  }
}

TEST(Dielectric, OfEqualIndicesIsNoInterface) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(12);
  const Dielectric none = Dielectric{1.37f, vec3(1)}.with_outside_ior(1.37f);
  for (int i = 0; i < 1000; ++i) {
    vec3 wo = random.direction();
    if (i % 2 == 0) wo = glm::normalize(vec3(wo.x, wo.y, 1e-5f * wo.z)); // grazing
    const auto s = none.sample(wo, random.three());
    ASSERT_TRUE(s);
    EXPECT_EQ(s->wi, -wo);
    EXPECT_EQ(s->weight, vec3(1));
    EXPECT_EQ(s->pdf, 1);
  }
}

TEST(Dielectric, CountsItsIndexAgainstTheOutside) {
  const Dielectric ice = Dielectric{1.31f, vec3(0.5f)}.with_outside_ior(1.33f);
  EXPECT_FLOAT_EQ(ice.ior, 1.31f / 1.33f);
  EXPECT_EQ(ice.transmittance, vec3(0.5f));
}

TEST(DielectricStatistical, ReflectsByTheFresnelShare) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(5);
  Dielectric glass{1.5f, vec3(1)};
  const vec3 directions[] = {direction(radians(10), 0), direction(radians(70), 0), direction(radians(85), 0),
                             direction(radians(150), 0)};
  for (vec3 wo : directions) {
    double r = double(fresnel_dielectric(std::abs(wo.z), wo.z > 0 ? 1.5f : 1 / 1.5f));
    constexpr int kDraws = 100000;
    std::vector<double> observed(2);
    for (int i = 0; i < kDraws; ++i) observed[glass.sample(wo, random.three())->wi.z * wo.z > 0 ? 0 : 1] += 1;
    std::vector<double> expected = {kDraws * r, kDraws * (1 - r)};
    EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(std::size(directions)));
  }
}

TEST(Mirror, IdealReflection) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(6);
  Mirror mirror{vec3(0.9f, 0.8f, 0.7f), vec3(0)};
  for (int i = 0; i < 100; ++i) {
    vec3 wo = random.direction();
    std::optional<BsdfSample> s = mirror.sample(wo, random.three());
    ASSERT_TRUE(s && s->delta);
    EXPECT_EQ(s->wi, vec3(-wo.x, -wo.y, wo.z));
    EXPECT_EQ(s->weight, mirror.specular);
    EXPECT_EQ(s->pdf, 1);
    EXPECT_TRUE(is_black(mirror.eval(wo, s->wi)));
  }
  EXPECT_EQ((Mirror{vec3(0.5f), vec3(0)}.delta_probability({0, 0, 1})), 1);
  EXPECT_EQ((Mirror{vec3(0), vec3(0.5f)}.delta_probability({0, 0, 1})), 0);
  EXPECT_FLOAT_EQ((Mirror{vec3(0.6f), vec3(0.2f)}.delta_probability({0, 0, 1})), 0.75f);
}

TEST(Mirror, ALobeIsWeightedByTheProbabilityOfItsChoice) {
  const Mirror mirror{vec3(0.5f, 0.6f, 0.7f), vec3(0.3f, 0.2f, 0.1f)};
  const vec3 wo = glm::normalize(vec3(0.3f, -0.2f, 0.8f));
  const float p = luminance(mirror.specular) / luminance(mirror.albedo());
  EXPECT_FLOAT_EQ(mirror.delta_probability(wo), p);
  for (const float lobe : {0.0f, 0.5f * p, 0.99f * p, 1.01f * p, 0.99f}) {
    const auto s = mirror.sample(wo, vec3(0.2f, 0.7f, lobe));
    ASSERT_TRUE(s);
    EXPECT_EQ(s->delta, lobe < p);
    const vec3 sent = s->weight * (s->delta ? p : 1 - p),
               expected = s->delta ? mirror.specular : mirror.diffuse;
    EXPECT_LT(glm::distance(sent, expected), 1e-6f) << lobe;
    EXPECT_FLOAT_EQ(s->pdf, s->delta ? p : mirror.pdf(wo, s->wi));
  }
}

} // namespace
} // namespace candela::test
