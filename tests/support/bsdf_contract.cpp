#include "support/bsdf_contract.h"

#include "support/seed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

namespace candela::test {

namespace {

class Random {
public:
  Random() : random_(fresh_seed() * 31 + stream++) {}
  float one() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
  vec3 three() {
    const float x = one(), y = one();
    return {x, y, one()};
  }
  vec3 direction() {
    const float x = one();
    return sample_uniform_sphere({x, one()});
  }

private:
  static inline std::atomic<std::uint64_t> stream = 5000;
  std::mt19937_64 random_;
};

vec3 at_degrees(float degrees_from_normal, float phi) {
  const float theta = radians(degrees_from_normal);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Where most of the light goes on wo's side, or on the other one.
vec3 peak_direction(const TestedBsdf& bsdf, vec3 wo, bool transmitted) {
  if (!transmitted) return reflect_about_normal(wo);
  const float eta = wo.z > 0 ? bsdf.ior : 1 / bsdf.ior;
  const float sine2 = (sqr(wo.x) + sqr(wo.y)) / sqr(eta);
  return glm::normalize(
      vec3(-wo.x / eta, -wo.y / eta, -std::copysign(safe_sqrt(1 - std::min(sine2, 0.99f)), wo.z)));
}

struct BothWays {
  vec3 forwards, backwards; ///< over the square of the outside's index, where they are on two sides
};
BothWays both_ways(const TestedBsdf& bsdf, vec3 wo, vec3 wi) {
  vec3 forwards = bsdf.eval_pdf(wo, wi, TransportMode::radiance).f_cos / std::abs(wi.z);
  vec3 backwards = bsdf.eval_pdf(wi, wo, TransportMode::radiance).f_cos / std::abs(wo.z);
  if (wo.z * wi.z < 0) (wo.z > 0 ? forwards : backwards) *= sqr(bsdf.ior);
  return {forwards, backwards};
}

/// Relative to the greater of both, or to 1/sr.
float relative_difference(vec3 a, vec3 b) {
  float most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]) / std::max({a[c], b[c], 1.0f}));
  return most;
}
float reciprocity_error(const TestedBsdf& bsdf, vec3 wo, vec3 wi) {
  const BothWays f = both_ways(bsdf, wo, wi);
  return relative_difference(f.forwards, f.backwards);
}
/// What a change of a direction by the last digits of a float makes of the value.
float digits_error(const TestedBsdf& bsdf, vec3 wo, vec3 wi) {
  const BothWays f = both_ways(bsdf, wo, wi);
  float most = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const float step : {-1.2e-7f, 1.2e-7f})
      for (const bool incident : {false, true}) {
        vec3 o = wo, i = wi;
        (incident ? i : o)[axis] += step;
        const BothWays g = both_ways(bsdf, o, i);
        most = std::max({most, relative_difference(f.forwards, g.forwards),
                         relative_difference(f.backwards, g.backwards)});
      }
  return most;
}

/// The greatest of the density and of each channel; values below the normal floats count as equal.
float relative_error(const BsdfEval& a, const BsdfEval& b) {
  auto error = [](float x, float y) {
    return std::abs(x - y) / std::max({std::abs(x), std::abs(y), 1e-30f});
  };
  return std::max({error(a.pdf, b.pdf), error(a.f_cos.x, b.f_cos.x), error(a.f_cos.y, b.f_cos.y),
                   error(a.f_cos.z, b.f_cos.z)});
}
/// What a change of wi by the last digits of a float makes of its value.
float digits_error(const TestedBsdf& bsdf, vec3 wo, vec3 wi, TransportMode mode, const BsdfEval& e) {
  float most = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const float step : {-1.2e-7f, 1.2e-7f}) {
      vec3 moved = wi;
      moved[axis] += step;
      most = std::max(most, relative_error(bsdf.eval_pdf(wo, moved, mode), e));
    }
  return most;
}

/// Its sides, as the flags say.
std::vector<bool> sides(const TestedBsdf& bsdf) {
  std::vector<bool> transmitted;
  if (has_any(bsdf.flags, BsdfFlags::reflection)) transmitted.push_back(false);
  if (has_any(bsdf.flags, BsdfFlags::transmission)) transmitted.push_back(true);
  return transmitted;
}

} // namespace

std::vector<vec3> contract_directions() {
  return {at_degrees(0, 0),       at_degrees(20, 0.3f),    at_degrees(45, 2),  at_degrees(75, -1),
          at_degrees(88, 4),      at_degrees(89.9f, 0.5f), at_degrees(180, 0), at_degrees(120, 1),
          at_degrees(100, -2.5f), at_degrees(90.1f, 2.2f)};
}

void expect_samples_agree(const TestedBsdf& bsdf) {
  SCOPED_TRACE(bsdf.name + "; " + seed_note());
  Random random;
  constexpr float tolerance = 2e-4f;
  const float edges[] = {0, 0x1p-24f, 0.5f, kOneMinusEpsilon};
  for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
    for (const vec3 wo : contract_directions()) {
      const float delta = bsdf.delta_probability(wo);
      auto check = [&](vec3 u) {
        const auto s = bsdf.sample(wo, u, mode);
        ASSERT_TRUE(!s || s->delta == (u.z < delta)) << "wo.z " << wo.z;
        if (!s) return;
        ASSERT_TRUE(is_finite(s->wi) && is_finite(s->weight) && std::isfinite(s->pdf) && s->pdf > 0 &&
                    s->eta > 0)
            << "wo.z " << wo.z;
        ASSERT_GE(min_component(s->weight), 0);
        ASSERT_NEAR(glm::length(s->wi), 1, 1e-4);
        const bool transmitted = s->wi.z * wo.z < 0;
        ASSERT_TRUE(has_any(bsdf.flags, transmitted ? BsdfFlags::transmission : BsdfFlags::reflection));
        if (s->delta) return;
        const BsdfEval e = bsdf.eval_pdf(wo, s->wi, mode);
        const BsdfEval sampled{s->weight * s->pdf, s->pdf};
        const float error = relative_error(sampled, e);
        const float allowed = error > tolerance ? 8 * digits_error(bsdf, wo, s->wi, mode, e) : 0;
        ASSERT_LE(error, tolerance + allowed)
            << "wo.z " << wo.z << " wi.z " << s->wi.z << " pdf " << s->pdf << " for " << e.pdf;
      };
      for (int i = 0; i < 200 && !testing::Test::HasFatalFailure(); ++i) check(random.three());
      for (float x : edges)
        for (float y : edges)
          for (float z : edges)
            if (const auto s = bsdf.sample(wo, vec3(x, y, z), mode)) {
              EXPECT_TRUE(is_finite(s->wi) && is_finite(s->weight) && std::isfinite(s->pdf) && s->pdf > 0);
            }
    }
    for (int i = 0; i < 1000; ++i) {
      const BsdfEval e = bsdf.eval_pdf(random.direction(), random.direction(), mode);
      EXPECT_TRUE(is_finite(e.f_cos) && std::isfinite(e.pdf) && min_component(e.f_cos) >= 0 && e.pdf >= 0);
    }
  }
}

void expect_directions_follow_pdf(const TestedBsdf& bsdf, vec3 wo, int cases, std::size_t draws) {
  SCOPED_TRACE(bsdf.name + "; " + seed_note());
  const float delta = bsdf.delta_probability(wo);
  if (delta >= 1) return;
  for (const bool transmitted : sides(bsdf)) {
    auto on_side = [&](vec3 wi) { return (wi.z * wo.z < 0) == transmitted; };
    auto pdf = [&](vec3 wi) {
      if (!on_side(wi)) return 0.0;
      return double(bsdf.eval_pdf(wo, wi, TransportMode::radiance).pdf) / (1 - double(delta));
    };
    // One in a hundred of all such tests is unlucky; three times in a row, one in a million.
    const double threshold = sidak_threshold(2 * cases, 0.01);
    double p_value = 0, integral = 0;
    for (int attempt = 0; attempt < 3 && !(p_value > threshold); ++attempt) {
      Random random;
      auto draw = [&](std::size_t) -> std::optional<vec3> {
        vec3 u = random.three();
        u.z = std::min(delta + u.z * (1 - delta), kOneMinusEpsilon);
        const auto s = bsdf.sample(wo, u, TransportMode::radiance);
        if (!s || !on_side(s->wi)) return std::nullopt;
        return s->wi;
      };
      const DirectionTest test =
          test_directions(SphereBins(peak_direction(bsdf, wo, transmitted), bsdf.width), draws, draw, pdf);
      p_value = test.chi_square.p_value;
      integral = test.pdf_integral;
    }
    EXPECT_GT(p_value, threshold) << "wo.z " << wo.z << (transmitted ? ", transmitted" : ", reflected")
                                  << ", integral of the density " << integral;
  }
}

void expect_reciprocal(const TestedBsdf& bsdf, int pairs, float tolerance) {
  SCOPED_TRACE(bsdf.name + "; " + seed_note());
  Random random;
  float worst = 0;
  vec3 worst_wo(0), worst_wi(0);
  for (int i = 0; i < pairs; ++i) {
    const vec3 wo = random.direction();
    vec3 wi = random.direction();
    if (!has_any(bsdf.flags, BsdfFlags::transmission)) wi = to_side_of(wo, wi);
    if (std::min(std::abs(wo.z), std::abs(wi.z)) < 1e-3f) continue;
    const float error = reciprocity_error(bsdf, wo, wi);
    // Near a narrow peak or total reflection the last digits of directions count: what they change is
    // allowed.
    const float allowed = error > tolerance ? 4 * digits_error(bsdf, wo, wi) : 0;
    if (error - allowed > worst) worst = error - allowed, worst_wo = wo, worst_wi = wi;
  }
  EXPECT_LE(worst, tolerance) << worst_wo.x << ' ' << worst_wo.y << ' ' << worst_wo.z << " to " << worst_wi.x
                              << ' ' << worst_wi.y << ' ' << worst_wi.z;
}

vec3 albedo_by_quadrature(const TestedBsdf& bsdf, vec3 wo) {
  vec3 albedo(0);
  for (const bool transmitted : sides(bsdf))
    for (int c = 0; c < 3; ++c) {
      auto f = [&](vec3 wi) {
        return (wi.z * wo.z < 0) == transmitted
                   ? double(bsdf.eval_pdf(wo, wi, TransportMode::importance).f_cos[c])
                   : 0;
      };
      albedo[c] += static_cast<float>(integrate_sphere(f, peak_direction(bsdf, wo, transmitted), bsdf.width));
    }
  return albedo;
}

SampledAlbedo albedo_by_samples(const TestedBsdf& bsdf, vec3 wo, int count) {
  Random random;
  SampledAlbedo albedo;
  for (int i = 0; i < count; ++i) {
    const auto s = bsdf.sample(wo, random.three(), TransportMode::importance);
    for (int c = 0; c < 3; ++c) albedo.channel[c].add(s ? double(s->weight[c]) : 0);
  }
  return albedo;
}

void expect_conserves_energy(const TestedBsdf& bsdf, int cases) {
  SCOPED_TRACE(bsdf.name + "; " + seed_note());
  const std::vector<vec3> directions = contract_directions();
  const double threshold = sidak_threshold(3 * cases * static_cast<int>(directions.size()));
  for (const vec3 wo : directions) {
    const vec3 exact = albedo_by_quadrature(bsdf, wo);
    EXPECT_LE(max_component(exact), 1 + 1e-4f) << "wo.z " << wo.z;
    if (bsdf.delta_probability(wo) > 0) continue; // samples have the delta lobes, too
    SampledAlbedo sampled = albedo_by_samples(bsdf, wo, 20000);
    for (int c = 0; c < 3; ++c) {
      RunningStatistics& weight = sampled.channel[c];
      // A run with few of the rare samples that carry nothing has a variance that says its mean is surer than
      // it is. Half a dozen more of those, and as many that put the mean right again, pay for that.
      for (int i = 0; i < 6; ++i) weight.add(0), weight.add(2 * double(exact[c]));
      EXPECT_GT(z_test(weight, double(exact[c]), 1e-3), threshold)
          << "wo.z " << wo.z << ": " << weight.mean() << " for " << exact[c];
    }
  }
}

} // namespace candela::test
