// The lobe proxy of a BSDF for light selection.

#include "materials/bsdf.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

float estimate(const LobeProxy& g, vec3 wo, vec3 wi) {
  float off = 1 + g.sharpness * (1 - glm::dot(reflect_about_normal(wo), wi));
  return g.diffuse * wi.z + g.peak / sqr(off);
}

vec3 at_angle(float degrees) { return {std::sin(radians(degrees)), 0, std::cos(radians(degrees))}; }

TEST(LobeProxy, LobesAreAsHighAndAsWideAsTheModels) {
  for (float roughness : {0.1f, 0.3f, 0.5f}) {
    const Bsdf ggx = Ggx{vec3(0.8f), roughness},
               phong = Phong{vec3(0.2f), vec3(0.5f), 2 / sqr(sqr(roughness))};
    for (float angle : {0.0f, 20.0f, 45.0f}) {
      vec3 wo = at_angle(-angle);
      float width = std::min(sqr(roughness) * (180 * kInvPi), 20.0f); // degrees
      for (float off : {0.0f, 0.5f, 1.0f})
        for (const Bsdf& bsdf : {ggx, phong}) {
          vec3 wi = at_angle(angle + off * width);
          float real = luminance(bsdf_eval(bsdf, wo, wi)),
                guess = estimate(bsdf_lobe_proxy(bsdf, wo), wo, wi);
          float ratio = guess / real;
          EXPECT_GT(ratio, 0.6f) << bsdf.index() << ' ' << roughness << ' ' << angle << ' ' << off;
          EXPECT_LT(ratio, 2.5f) << bsdf.index() << ' ' << roughness << ' ' << angle << ' ' << off;
        }
    }
  }
}

TEST(LobeProxy, AlbedoIsTheLobesIntegral) {
  LobeProxy g = Phong{vec3(0), vec3(0.5f), 60}.lobe_proxy(at_angle(0));
  constexpr int kSteps = 100000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) { // over the cosine with the axis, in the hemisphere
    float off = 1 + g.sharpness * (static_cast<float>(i) + 0.5f) / kSteps;
    sum += static_cast<double>(g.peak / sqr(off)) * 2 * std::numbers::pi / kSteps;
  }
  EXPECT_NEAR(static_cast<double>(g.lobe_albedo()), sum, 1e-4 * sum);
}

TEST(LobeProxy, IsNotZeroWhereTheModelIsNot) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(fresh_seed()));
  std::uniform_real_distribution<float> u;
  auto upwards = [&] { // one by one: arguments have no order
    float x = u(random), y = u(random);
    return sample_uniform_hemisphere({x, y});
  };
  for (int i = 0; i < 20000; ++i) {
    vec3 wo = upwards(), wi = upwards();
    for (const Bsdf& bsdf : {Bsdf(Ggx{vec3(0.8f), 0.2f}), Bsdf(Ggx{vec3(0.8f), 0.8f}),
                             Bsdf(Phong{vec3(0.1f), vec3(0.5f), 30}), Bsdf(Diffuse{vec3(0.5f)})})
      if (float real = luminance(bsdf_eval(bsdf, wo, wi)); real > 0) {
        ASSERT_GT(estimate(bsdf_lobe_proxy(bsdf, wo), wo, wi), 0.01f * real)
            << bsdf.index() << ' ' << wo.z << ' ' << wi.z << "; " << seed_note();
      }
  }
}

} // namespace
} // namespace candela::test
