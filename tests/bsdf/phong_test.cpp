#include "bsdf/bsdf_test_models.h"
#include "bsdf/phong.h"
#include "support/direction_statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

TEST(Phong, LobeIsNormalisedAtTheNormal) {
  // (n + 2) / (2 pi) cos^n cos integrates to 1 where the lobe is about the normal.
  for (float n : {0.0f, 1.0f, 10.0f, 200.0f, 5000.0f}) {
    Phong phong{vec3(0), vec3(0.7f), n};
    auto f = [&](vec3 wi) { return double(phong.eval({0, 0, 1}, wi).x); };
    EXPECT_NEAR(integrate_sphere(f, {0, 0, 1}, 2 / std::sqrt(double(n) + 1)), 0.7, 2e-3) << n;
  }
}

TEST(Phong, LobeOfExponentOneHasAClosedForm) {
  // 3 / (2 pi) times the integral of max(0, cos alpha) cos(theta) over the upper hemisphere. With t the angle
  // of the mirror direction to the normal it is (2 / 3) pi times ((pi - t) cos t + sin t) / pi (the projected
  // area of a lune).
  Phong phong{vec3(0), vec3(1), 1};
  for (float degree : {0.0f, 30.0f, 60.0f, 85.0f}) {
    vec3 wo = direction(radians(degree), 0.7f);
    double t = double(radians(degree));
    double exact = ((std::numbers::pi - t) * std::cos(t) + std::sin(t)) / std::numbers::pi;
    auto f = [&](vec3 wi) { return double(phong.eval(wo, wi).x); };
    EXPECT_NEAR(integrate_sphere(f), exact, 1e-3) << degree;
  }
}

TEST(Phong, LobesAreChosenByLuminance) {
  EXPECT_EQ((Phong{vec3(0.5f), vec3(0), 10}.specular_probability()), 0);
  EXPECT_EQ((Phong{vec3(0), vec3(0.5f), 10}.specular_probability()), 1);
  EXPECT_FLOAT_EQ((Phong{vec3(0.25f), vec3(0.75f), 10}.specular_probability()), 0.75f);
}

TEST(Phong, LobeIsAboutTheMirrorDirection) {
  Phong phong{vec3(0), vec3(1), 500};
  for (vec3 wo : outgoing_directions()) {
    if (std::abs(wo.z) < 0.2f) continue;
    vec3 mirrored(-wo.x, -wo.y, wo.z);
    RandomNumbers random(1);
    vec3 mean(0);
    for (int i = 0; i < 1000; ++i)
      if (auto s = phong.sample(wo, random.three())) mean += s->wi;
    EXPECT_GT(glm::dot(glm::normalize(mean), mirrored), 0.999f);
    // Rounding of a cosine near 1, to the 500th power.
    EXPECT_NEAR(phong.eval(wo, mirrored).x / (502 / (2 * kPi) * std::abs(wo.z)), 1, 500 * 2e-7);
  }
}

} // namespace
} // namespace candela::test
