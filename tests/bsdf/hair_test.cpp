#include "bsdf/hair.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

using glm::dvec3;
constexpr double kTau = 2 * std::numbers::pi;

/// Along the fibre sin_theta, around it by phi from +y.
vec3 around(double theta, double phi) {
  return vec3(std::sin(theta), std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi));
}

class Random {
public:
  explicit Random(std::uint64_t stream) : random_(fresh_seed() * 31 + stream) {}
  float one() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
  vec3 three() {
    const float x = one(), y = one();
    return {x, y, one()};
  }
  vec3 direction() {
    const vec3 u = three();
    return sample_uniform_sphere({u.x, u.y});
  }

private:
  std::mt19937_64 random_;
};

std::string name(const Hair& hair) {
  return fmt::format("hair beta_m {} beta_n {} h {} sigma_a {} ior {} tilt {}", hair.beta_m, hair.beta_n,
                     hair.h, hair.sigma_a.x, hair.ior, hair.tilt);
}

std::vector<Hair> hairs(std::initializer_list<float> betas, std::initializer_list<float> offsets) {
  std::vector<Hair> all;
  for (const float m : betas)
    for (const float n : betas)
      for (const float h : offsets) all.push_back({{0.2f, 0.5f, 1.3f}, m, n, radians(2), 1.55f, h});
  return all;
}

// The textbook, in double and in angles (pbrt-v4, section 9.9).

double bessel(double x) { return std::cyl_bessel_i(0.0, x); }
/// As Mitsuba approximates it: eleven terms of the power series, or the asymptotic one with half of its
/// second term.
double bessel_of_mitsuba(double x) {
  if (x > 12) return std::exp(x + 0.5 * (-std::log(kTau * x) + 1 / (8 * x)));
  double sum = 0, factorial = 1;
  for (int i = 0; i <= 10; ++i) {
    if (i > 1) factorial *= i;
    sum += std::pow(x, 2 * i) / (std::pow(4.0, i) * factorial * factorial);
  }
  return sum;
}
double fresnel(double cosine, double eta) {
  const double c = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
  return 0.5 * (std::pow((eta * cosine - c) / (eta * cosine + c), 2) +
                std::pow((cosine - eta * c) / (cosine + eta * c), 2));
}
dvec3 textbook(const Hair& hair, vec3 wo, vec3 wi, double (*i0)(double)) {
  const double theta_o = std::asin(double(wo.x)), theta_i = std::asin(double(wi.x));
  const double phi = std::atan2(double(wi.z), double(wi.y)) - std::atan2(double(wo.z), double(wo.y));
  const double m = double(hair.beta_m), n = double(hair.beta_n), eta = double(hair.ior);
  const double v0 = std::pow(0.726 * m + 0.812 * m * m + 3.7 * std::pow(m, 20), 2);
  const double v[] = {v0, v0 / 4, 4 * v0, 4 * v0};
  const double s = std::sqrt(kTau / 16) * (0.265 * n + 1.194 * n * n + 5.372 * std::pow(n, 22));
  const double theta_t = std::asin(std::sin(theta_o) / eta), gamma_o = std::asin(double(hair.h));
  const double projected = std::sqrt(eta * eta - std::pow(std::sin(theta_o), 2)) / std::cos(theta_o);
  const double gamma_t = std::asin(double(hair.h) / projected);
  const dvec3 t = glm::exp(-dvec3(hair.sigma_a) * (2 * std::cos(gamma_t) / std::cos(theta_t)));
  const double f = fresnel(std::cos(theta_o) * std::cos(gamma_o), eta);
  dvec3 a[4] = {dvec3(f), (1 - f) * (1 - f) * t};
  a[2] = a[1] * t * f;
  a[3] = a[2] * f * t / (1.0 - t * f);
  const double turns[] = {-2, 1, 4, 0};
  dvec3 sum(0);
  for (int p = 0; p < 4; ++p) {
    const double theta = theta_o + turns[p] * double(hair.tilt);
    const double longitudinal = std::exp(-std::sin(theta_i) * std::sin(theta) / v[p]) *
                                i0(std::cos(theta_i) * std::abs(std::cos(theta)) / v[p]) /
                                (2 * v[p] * std::sinh(1 / v[p]));
    double azimuthal = 1 / kTau;
    if (p < 3) {
      const double x = std::remainder(phi - (2 * p * gamma_t - 2 * gamma_o + p * kTau / 2), kTau);
      auto cdf = [&](double at) { return 1 / (1 + std::exp(-at / s)); };
      azimuthal = cdf(x) * cdf(-x) / s / (cdf(kTau / 2) - cdf(-kTau / 2));
    }
    sum += a[p] * (longitudinal * azimuthal);
  }
  return sum;
}

TEST(Hair, AgainstTheTextbook) {
  SCOPED_TRACE(seed_note());
  Random random(1);
  for (const Hair& hair : hairs({0.1f, 0.3f, 0.6f, 1}, {-0.9f, -0.2f, 0, 0.5f, 1}))
    for (int i = 0; i < 100; ++i) {
      const vec3 wo = random.direction(), wi = random.direction();
      const dvec3 expected = textbook(hair, wo, wi, bessel);
      const Spectrum f_cos = hair.eval(wo, wi);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double(f_cos[c]), expected[c], 2e-4 * expected[c] + 1e-6) << name(hair);
    }
}

TEST(Hair, AgainstMitsuba) {
  // Mitsuba 3.9.1: hair, sigma_a .2 .5 1.3, scale 1, longitudinal_roughness .3, azimuthal_roughness .4,
  // scale_tilt 2, int_ior 1.55, ext_ior 1; bsdf.eval(ctx, si, w) with si.wi and w below, normalised. Its
  // fibre lies along y, and its normal is a cylinder's.
  struct Known {
    vec3 wi, value;
  };
  auto ours = [](vec3 w) { return glm::normalize(vec3(w.y, -w.x, w.z)); };
  const vec3 wo = ours({0.3f, 0.2f, 0.9f});
  Hair hair{{0.2f, 0.5f, 1.3f}, 0.3f, 0.4f};
  hair.h = Hair::offset_on_cylinder(wo);
  for (const auto& [wi, value] : {Known{{-0.4f, 0.1f, 0.9f}, {0.0591313f, 0.0587723f, 0.0586329f}},
                                  Known{{-0.2f, -0.5f, 0.7f}, {0.0287463f, 0.0278257f, 0.0274503f}},
                                  Known{{0.1f, 0.3f, -1}, {0.00269579f, 0.00146948f, 0.000300569f}},
                                  Known{{-0.6f, -0.7f, -0.2f}, {6.58909e-05f, 1.84407e-05f, 6.70851e-06f}}}) {
    const dvec3 approximate = textbook(hair, wo, ours(wi), bessel_of_mitsuba);
    const Spectrum f_cos = hair.eval(wo, ours(wi));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(approximate[c], double(value[c]), 1e-4 * double(value[c]));
      // Its Bessel function is up to 0.5 % off.
      EXPECT_NEAR(double(f_cos[c]), double(value[c]), 5e-3 * double(value[c]));
    }
  }
}

TEST(HairLobes, BesselFunction) {
  for (double x = 0; x < 60; x += 0.37)
    EXPECT_NEAR(double(scaled_bessel_i0(float(x))) / (std::exp(-double(float(x))) * bessel(double(float(x)))),
                1, 2e-6)
        << x;
  EXPECT_NEAR(scaled_bessel_i0(1e6f) * std::sqrt(2 * kPi * 1e6f), 1, 1e-6);
}

TEST(HairLobes, EachIsADensity) {
  for (const double beta : {0.02, 0.1, 0.3, 0.6, 1.0}) {
    const double v = std::pow(0.726 * beta + 0.812 * beta * beta + 3.7 * std::pow(beta, 20), 2);
    for (const double variance : {v / 4, 4 * v}) {
      const HairLongitudinal longitudinal{float(variance)};
      for (const double theta : {0.0, 0.7, -1.3, 1.57}) {
        // About the peak, in its width.
        double sum = 0;
        constexpr int kSteps = 20000;
        const double reach = std::min(kTau / 2, 12 * std::sqrt(variance)), step = 2 * reach / kSteps;
        for (int i = 0; i < kSteps; ++i) {
          const double at = -theta - reach + (i + 0.5) * step;
          if (std::abs(at) > kTau / 4) continue;
          sum += double(longitudinal.density(float(std::cos(at)), float(std::sin(at)), float(std::cos(theta)),
                                             float(std::sin(theta)))) *
                 std::cos(at) * step;
        }
        EXPECT_NEAR(sum, 1, 3e-4) << beta << ' ' << variance << ' ' << theta;
      }
    }
    const double s = std::sqrt(kTau / 16) * (0.265 * beta + 1.194 * beta * beta + 5.372 * std::pow(beta, 22));
    const HairAzimuthal azimuthal{float(s)};
    double sum = 0;
    for (double x = -kTau / 2, step = kTau / 100000; x < kTau / 2; x += step)
      sum += double(azimuthal.density(float(x + 0.5 * step))) * step;
    EXPECT_NEAR(sum, 1, 1e-4) << beta;
    // Of float angles, which are rounded by up to 1e-6 each; so is the product of turns and 2 pi.
    const double angle = std::min(3 * s, 2.0);
    for (const double turns : {-2.0, 1.0, 3.0})
      EXPECT_NEAR(double(azimuthal.density(float(angle + turns * kTau)) / azimuthal.density(float(angle))), 1,
                  3e-6 / s)
          << beta << ' ' << turns;
    // Its samples have its distribution function.
    for (const double u : {0.001, 0.1, 0.3, 0.5, 0.77, 0.999}) {
      const double x = double(azimuthal.sample(float(u)));
      auto cdf = [&](double at) { return 1 / (1 + std::exp(-at / s)); };
      EXPECT_NEAR((cdf(x) - cdf(-kTau / 2)) / (cdf(kTau / 2) - cdf(-kTau / 2)), u, 2e-6) << beta;
    }
  }
}

TEST(Hair, WhiteFurnace) {
  // All that leaves without absorption, by quadrature over both angles, for every offset.
  for (const auto& [m, n] : {std::pair(0.15f, 0.2f), {0.3f, 0.3f}, {0.4f, 0.9f}, {1.0f, 0.25f}, {1.0f, 1.0f}})
    for (const float h : {-1.0f, -0.6f, 0.0f, 0.3f, 0.95f})
      for (const double theta : {0.0, 0.5, -1.2, 1.5}) {
        const Hair hair{Spectrum(0), m, n, radians(2), 1.55f, h};
        const HairLobes lobes = hair.lobes(around(theta, 0.8));
        double sum = 0;
        constexpr int kThetas = 300, kPhis = 300;
        for (int i = 0; i < kThetas; ++i) {
          const double t = ((i + 0.5) / kThetas - 0.5) * kTau / 2;
          for (int j = 0; j < kPhis; ++j)
            sum += double(lobes.eval_pdf(around(t, (j + 0.5) / kPhis * kTau)).f_cos.y) * std::cos(t);
        }
        EXPECT_NEAR(sum * (kTau / 2 / kThetas) * (kTau / kPhis), 1, 1e-3) << name(hair) << ' ' << theta;
      }
}

TEST(Hair, SampledWhiteFurnace) {
  SCOPED_TRACE(seed_note());
  // Over random offsets and directions. Every sample weighs 1, for the density is the light itself.
  Random random(2);
  for (const float m : {Hair::kMinBeta, 0.1f, 0.5f, 1.0f})
    for (const float n : {Hair::kMinBeta, 0.1f, 0.5f, 1.0f}) {
      double sum = 0;
      constexpr int kCount = 4000;
      for (int i = 0; i < kCount; ++i) {
        const Hair hair{Spectrum(0), m, n, radians(2), 1.55f, 2 * random.one() - 1};
        const auto s = hair.sample(random.direction(), random.three());
        ASSERT_TRUE(s);
        EXPECT_NEAR(s->weight.x, 1, 1e-4);
        sum += double(s->weight.x);
      }
      EXPECT_NEAR(sum / kCount, 1, 1e-3);
    }
}

TEST(HairStatistical, AlbedoIsTheSumOfTheAttenuations) {
  SCOPED_TRACE(seed_note());
  const auto all = hairs({0.05f, 0.3f, 0.8f}, {-0.7f, 0, 0.97f});
  for (const Hair& hair : all)
    for (const double theta : {0.1, -0.9, 1.5}) {
      const vec3 wo = around(theta, 2);
      const HairLobes lobes = hair.lobes(wo);
      Spectrum exact(0);
      for (const Spectrum a : lobes.attenuation()) exact += a;
      EXPECT_LE(max_component(exact), 1);
      const SampledAlbedo sampled = albedo_by_samples(tested(name(hair), hair), wo, 20000);
      for (int c = 0; c < 3; ++c)
        EXPECT_GT(z_test(sampled.channel[c], double(exact[c]), 1e-4),
                  sidak_threshold(9 * static_cast<int>(all.size())))
            << name(hair) << ' ' << theta << ": " << sampled.channel[c].mean() << " for " << exact[c];
    }
}

TEST(Hair, SamplesAgree) {
  for (const Hair& hair : hairs({Hair::kMinBeta, 0.3f, 1}, {-1, -0.4f, 0, 0.999f}))
    expect_samples_agree(tested(name(hair), hair, double(std::min(hair.beta_n, hair.beta_m))));
  for (const float ior : {1.0f, 1.55f, 3.0f})
    for (const float sigma : {0.0f, 1e6f})
      for (const float h : {-1.0f, 0.0f, 1.0f}) {
        const Hair hair{Spectrum(sigma), 0.3f, 0.3f, radians(-20), ior, h};
        expect_samples_agree(tested(name(hair), hair));
        for (const vec3 wo : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0)})
          for (const vec3 u : {vec3(0), vec3(0.5f), vec3(0.3f, 0.9f, kOneMinusEpsilon)})
            if (const auto s = hair.sample(wo, u)) {
              EXPECT_TRUE(is_finite(s->wi) && is_finite(s->weight) && s->pdf > 0) << name(hair);
              EXPECT_NEAR(hair.pdf(wo, s->wi) / s->pdf, 1, 1e-3) << name(hair);
            }
      }
}

TEST(HairStatistical, DirectionsFollowThePdf) {
  const auto all = hairs({0.25f, 1}, {-0.8f, 0, 0.4f});
  const auto directions = contract_directions();
  for (const Hair& hair : all)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(tested(name(hair), hair), wo,
                                   static_cast<int>(all.size() * directions.size()), 20000);
}

TEST(HairStatistical, NarrowConesFollowThePdf) {
  SCOPED_TRACE(seed_note());
  // Bins whose rings are cones around the fibre.
  auto upright = [](vec3 w) { return vec3(w.y, w.z, w.x); };
  auto lying = [](vec3 w) { return vec3(w.z, w.x, w.y); };
  Random random(3);
  const double thetas[] = {0.05, -0.6, 1.3};
  for (const double theta : thetas) {
    const Hair hair{Spectrum(0.2f), 0.06f, 0.35f, radians(3), 1.55f, 0.3f};
    const vec3 wo = around(theta, 1);
    double p_value = 0;
    const double threshold = sidak_threshold(3, 0.01);
    for (int attempt = 0; attempt < 3 && !(p_value > threshold); ++attempt)
      p_value = test_directions(
                    SphereBins(upright(vec3(-wo.x, wo.y, wo.z)), 0.1, 40, 24), 60000,
                    [&](std::size_t) -> std::optional<vec3> {
                      const auto s = hair.sample(wo, random.three());
                      if (!s) return std::nullopt;
                      return upright(s->wi);
                    },
                    [&](vec3 w) { return double(hair.pdf(wo, lying(w))); })
                    .chi_square.p_value;
    EXPECT_GT(p_value, threshold) << theta;
  }
}

TEST(Hair, ReflectsAsACylinderWhereItsNormalSays) {
  SCOPED_TRACE(seed_note());
  // With a body that absorbs all, only the lobe about the mirror direction is left.
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    vec3 wo = random.direction();
    wo.z = std::abs(wo.z);
    Hair hair{Spectrum(1e6f), 0.1f, 0.1f, 0};
    hair.h = Hair::offset_on_cylinder(wo);
    const vec3 mirrored = reflect_about_normal(wo);
    const float peak = hair.pdf(wo, mirrored), across = std::sqrt(sqr(wo.y) + sqr(wo.z));
    for (const float turn : {-0.5f, -0.05f, 0.05f, 0.5f, 3.0f}) {
      const float phi = std::atan2(mirrored.z, mirrored.y) + turn;
      EXPECT_GT(peak, hair.pdf(wo, {mirrored.x, across * std::cos(phi), across * std::sin(phi)}));
    }
  }
}

TEST(Hair, OffsetOfARoundFibre) {
  // Rays along -z to a fibre along x: what they meet at y has a normal, and a frame of it.
  for (const float y : {-0.99f, -0.3f, 0.0f, 0.7f}) {
    const vec3 normal(0, y, std::sqrt(1 - sqr(y))), tangent(1, 0, 0), across = glm::cross(normal, tangent);
    const vec3 w(0, 0, 1), wo(glm::dot(w, tangent), glm::dot(w, across), glm::dot(w, normal));
    EXPECT_NEAR(Hair::offset_on_cylinder(wo), y, 1e-6);
    EXPECT_NEAR(glm::dot(glm::cross(w, tangent), normal), y, 1e-6);
  }
}

TEST(Hair, AbsorptionOfPigmentsAndColours) {
  const Spectrum brown = Hair::absorption_of_melanin(1.3f, 0), red = Hair::absorption_of_melanin(0, 2);
  const double eumelanin[] = {0.419, 0.697, 1.37}, pheomelanin[] = {0.187, 0.4, 1.05}; // d'Eon et al. 2011
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(brown[c], 1.3 * eumelanin[c], 1e-6);
    EXPECT_NEAR(red[c], 2 * pheomelanin[c], 1e-6);
  }
  // pbrt-v4's HairBxDF::SigmaAFromReflectance at beta_n = 0.3: (ln c / 5.9088...)^2.
  const double b = 0.3;
  const double fit = 5.969 - 0.215 * b + 2.532 * std::pow(b, 2) - 10.73 * std::pow(b, 3) +
                     5.574 * std::pow(b, 4) + 0.245 * std::pow(b, 5);
  EXPECT_NEAR(Hair::absorption_of_color({0.5f, 0.1f, 1}, 0.3f).x, std::pow(std::log(0.5) / fit, 2), 1e-6);
  for (const float beta : {0.1f, 0.5f, 1.0f}) {
    Hair hair;
    hair.beta_n = beta;
    hair.sigma_a = Hair::absorption_of_color({0.5f, 0.1f, 1}, beta);
    EXPECT_NEAR(hair.albedo().x, 0.5, 1e-5);
    EXPECT_NEAR(hair.albedo().y, 0.1, 1e-5);
    EXPECT_NEAR(hair.albedo().z, 1, 1e-5);
  }
  EXPECT_TRUE(is_finite(Hair::absorption_of_color(Spectrum(0), 0.3f)));
}

} // namespace
} // namespace candela::test
