#include "bsdf/bsdf_test_models.h"
#include "materials/direction_sampling.h"
#include "support/direction_statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

constexpr DirectionSampling kStrategies[] = {DirectionSampling::uniform, DirectionSampling::cosine,
                                             DirectionSampling::bsdf};

/// Radiance that arrives: smooth, and not symmetric about anything.
double incident(vec3 wi) {
  return 1 + 0.5 * double(wi.x) - 0.3 * double(wi.y) + 0.2 * double(wi.x * wi.y) + 0.4 * double(wi.z);
}

TEST(DirectionSampling, SampleAgreesWithEvalAndPdf) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(1);
  for (const NamedBsdf& m : glossy_models()) {
    for (vec3 wo : outgoing_directions()) {
      for (DirectionSampling how : kStrategies) {
        for (int i = 0; i < 100; ++i) {
          vec3 u = random.three();
          std::optional<BsdfSample> s = sample_direction(m.bsdf, wo, u, how);
          EXPECT_EQ(u.z < bsdf_delta_probability(m.bsdf, wo), s && s->delta);
          if (!s || s->delta) continue;
          BsdfEval e = direction_eval_pdf(m.bsdf, wo, s->wi, how);
          ASSERT_EQ(e.pdf, direction_pdf(m.bsdf, wo, s->wi, how));
          ASSERT_NEAR(s->pdf / e.pdf, 1, 1e-5) << m.name;
          for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(s->weight[c] * s->pdf, e.f_cos[c], 1e-5 * e.f_cos[c]) << m.name;
        }
      }
    }
  }
}

TEST(DirectionSampling, PdfIntegratesToTheChanceOfNoDeltaLobe) {
  for (const Bsdf& bsdf :
       {Bsdf(Diffuse{}), Bsdf(Mirror{vec3(0.6f), vec3(0.2f)}), Bsdf(Mirror{vec3(1), vec3(0)})}) {
    for (vec3 wo : outgoing_directions()) {
      for (DirectionSampling how : kStrategies) {
        double integral = integrate_sphere([&](vec3 wi) { return double(direction_pdf(bsdf, wo, wi, how)); });
        EXPECT_NEAR(integral, 1 - double(bsdf_delta_probability(bsdf, wo)), 1e-4);
      }
    }
  }
}

TEST(DirectionSampling, StrategiesCoverBothSidesOfWhatTransmitsWithADensity) {
  RandomNumbers random(5);
  for (DirectionSampling how : {DirectionSampling::uniform, DirectionSampling::cosine})
    for (bool both_sides : {false, true})
      for (vec3 wo : outgoing_directions()) {
        auto pdf = [&](vec3 wi) { return double(detail::strategy_pdf(wo, wi, how, both_sides)); };
        EXPECT_NEAR(integrate_sphere(pdf), 1, 1e-4);
        // The mean of a function of the density, both ways: over the sphere and by the samples.
        double estimate = 0;
        int behind = 0;
        constexpr int kCount = 4000;
        for (int i = 0; i < kCount; ++i) {
          const BsdfU u = random.three();
          const vec3 wi = detail::strategy_direction(wo, u.disc, u.lobe, how, both_sides);
          if (wi.z == 0) continue; // by rounding: sample_direction() drops it
          ASSERT_GT(pdf(wi), 0);
          estimate += double(sqr(wi.z)) / kCount;
          behind += !same_hemisphere(wo, wi);
        }
        const double expected = integrate_sphere([&](vec3 wi) { return pdf(wi) * double(sqr(wi.z)); });
        EXPECT_NEAR(estimate, expected, 0.03); // 6 sigma
        EXPECT_NEAR(behind, both_sides ? kCount / 2 : 0, both_sides ? 3 * std::sqrt(double(kCount)) : 0.5);
      }
}

TEST(DirectionSampling, GlassIsAllDelta) {
  RandomNumbers random(2);
  Bsdf glass = Dielectric{1.5f, vec3(0.9f)};
  for (DirectionSampling how : kStrategies) {
    for (int i = 0; i < 100; ++i) {
      vec3 wo = random.direction(), u = random.three();
      std::optional<BsdfSample> a = sample_direction(glass, wo, u, how), b = bsdf_sample(glass, wo, u);
      ASSERT_TRUE(a && b && a->delta);
      EXPECT_EQ(a->wi, b->wi);
      EXPECT_EQ(a->weight, b->weight);
    }
  }
}

TEST(DirectionSamplingStatistical, DirectionsFollowThePdf) {
  SCOPED_TRACE(seed_note());
  Bsdf bsdf = Phong{vec3(0.3f), vec3(0.5f), 10};
  std::uint64_t stream = 50;
  for (DirectionSampling how : {DirectionSampling::uniform, DirectionSampling::cosine}) {
    for (vec3 wo : {direction(radians(30), 1), direction(radians(130), 1)}) {
      RandomNumbers random(stream++);
      auto draw = [&](std::size_t) -> std::optional<vec3> {
        std::optional<BsdfSample> s = sample_direction(bsdf, wo, random.three(), how);
        if (!s) return std::nullopt;
        return s->wi;
      };
      auto pdf = [&](vec3 wi) { return double(direction_pdf(bsdf, wo, wi, how)); };
      DirectionTest t = test_directions(SphereBins({0, 0, 1}, 1), 400000, draw, pdf);
      EXPECT_GT(t.chi_square.p_value, sidak_threshold(4));
    }
  }
}

/// Every strategy estimates the same reflected radiance: that by quadrature, and the delta lobe's.
TEST(DirectionSamplingStatistical, AllStrategiesHaveTheSameExpectation) {
  SCOPED_TRACE(seed_note());
  std::vector<NamedBsdf> models;
  for (const NamedBsdf& m : glossy_models())
    if (m.width > 0.1) models.push_back(m); // narrower lobes are hardly ever met by a uniform direction
  std::vector<vec3> outgoing = outgoing_directions();
  int tests = static_cast<int>(3 * 3 * models.size() * outgoing.size());
  std::uint64_t stream = 10000;
  for (const NamedBsdf& m : models) {
    for (vec3 wo : outgoing) {
      vec3 mirrored = reflect_about_normal(wo);
      double exact[3];
      for (int c = 0; c < 3; ++c) {
        auto f = [&](vec3 wi) { return double(bsdf_eval(m.bsdf, wo, wi)[c]) * incident(wi); };
        exact[c] = integrate_sphere(f, mirrored, m.width);
        if (const auto* mirror = std::get_if<Mirror>(&m.bsdf))
          exact[c] += double(mirror->specular[c]) * incident(mirrored);
      }
      for (DirectionSampling how : kStrategies) {
        // Grazing lobes of some models are a rare event for the hemisphere: too skewed for a z-test.
        if (how != DirectionSampling::bsdf && m.width < 0.5 && std::abs(wo.z) < 0.1f) continue;
        RunningStatistics estimate[3];
        RandomNumbers random(stream++);
        for (int i = 0; i < 40000; ++i) {
          std::optional<BsdfSample> s = sample_direction(m.bsdf, wo, random.three(), how);
          for (int c = 0; c < 3; ++c) estimate[c].add(s ? double(s->weight[c]) * incident(s->wi) : 0);
        }
        for (int c = 0; c < 3; ++c)
          EXPECT_GT(z_test(estimate[c], exact[c], 1e-4), sidak_threshold(tests))
              << m.name << " wo.z " << wo.z << " strategy " << static_cast<int>(how) << ": "
              << estimate[c].mean() << " for " << exact[c];
      }
    }
  }
}

} // namespace
} // namespace candela::test
