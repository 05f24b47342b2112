// What a body is made of by its colour, and the profiles of light that diffuses in it.

#include "core/hash.h"
#include "core/statistics.h"
#include "media/albedo_inversion.h"
#include "media/diffusion_profile.h"
#include "media/measured_media.h"
#include "support/chandrasekhar.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

namespace candela::test {
namespace {

TEST(AlbedoInversion, IsThatOfChandrasekharsHalfSpace) {
  double worst = 0;
  for (const double albedo : {0.05, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.999, 1.0}) {
    const double exact = ChandrasekharH(albedo).mean_albedo();
    const double error = static_cast<double>(half_space_albedo(static_cast<float>(albedo))) - exact;
    EXPECT_LT(std::abs(error), 2.2e-3) << albedo;
    worst = std::max(worst, std::abs(error));
  }
  EXPECT_GT(worst, 1.9e-3) << "the stated error is the real one";
}

TEST(AlbedoInversion, InvertsExactly) {
  for (float color = 0; color <= 1; color += 1.0f / 64)
    EXPECT_NEAR(half_space_albedo(single_scattering_albedo(color)), color, 2e-4 * (1 - color) + 1e-6)
        << color;
  EXPECT_EQ(single_scattering_albedo(1), 1);
  EXPECT_NEAR(single_scattering_albedo(0), 0, 1e-6);
}

TEST(AlbedoInversion, WithoutAnInterfaceNothingIsThrownBack) {
  EXPECT_EQ(albedo_below_interface(0.3f, 1), 0.3f);
  EXPECT_EQ(albedo_below_interface(1, 1.5f), 1);
  // 0.6 of what comes up is thrown back, so it takes more to give the same.
  const float below = albedo_below_interface(0.5f, 1.5f), inside = 0.596346f;
  EXPECT_NEAR((1 - inside) * below / (1 - inside * below), 0.5f, 1e-6f);
}

/// Jensen et al. 2001, eq. 4, as it is printed there.
double dipole_reflectance(double r, double alpha, double mean_free_path, double a) {
  const double sigma_t = 1 / mean_free_path, sigma_tr = sigma_t * std::sqrt(3 * (1 - alpha));
  const double zr = mean_free_path, zv = zr * (1 + 4.0 / 3 * a), dr = std::hypot(r, zr),
               dv = std::hypot(r, zv);
  return alpha / (4 * std::numbers::pi) *
         (zr * (1 + sigma_tr * dr) * std::exp(-sigma_tr * dr) / (dr * dr * dr) +
          zv * (1 + sigma_tr * dv) * std::exp(-sigma_tr * dv) / (dv * dv * dv));
}

/// The integral over the plane up to a distance, by Simpson's rule in a distance that grows faster than
/// linearly.
double over_disc(const std::function<double(double)>& value, double end) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double u = static_cast<double>(i) / n, r = end * u * u * u;
    const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * value(std::max(r, 1e-12)) * 2 * std::numbers::pi * r * 3 * end * u * u;
  }
  return sum / (3 * n);
}

TEST(DipoleProfile, TotalReflectanceIsTheIntegral) {
  for (const float ior : {1.0f, 1.3f, 1.5f})
    for (const float alpha : {0.1f, 0.5f, 0.9f, 0.99f}) {
      const double a = static_cast<double>(DipoleProfile::boundary_term(ior));
      const double total = static_cast<double>(DipoleProfile::total_reflectance(alpha, ior));
      const double far = 60 / std::sqrt(3 * (1 - static_cast<double>(alpha)));
      const double sum =
          over_disc([&](double r) { return dipole_reflectance(r, static_cast<double>(alpha), 1, a); }, far);
      EXPECT_NEAR(total, sum, 1e-5) << alpha << ' ' << ior;
      EXPECT_NEAR(DipoleProfile::reduced_albedo(DipoleProfile::total_reflectance(alpha, ior), ior), alpha,
                  1e-5f);
    }
  EXPECT_NEAR(DipoleProfile::boundary_term(1), 1, 1e-6f);
  EXPECT_NEAR(DipoleProfile::boundary_term(1.5f), (1 + 0.596346f) / (1 - 0.596346f), 1e-4f);
}

/// The column "diffuse reflectance" of Jensen et al. 2001, figure 5, from which they have the coefficients.
TEST(DipoleProfile, ReflectsWhatWasMeasured) {
  struct Known {
    std::string_view name;
    vec3 reflectance;
  };
  for (const Known& known : {Known{"apple", {0.85f, 0.84f, 0.53f}}, Known{"chicken1", {0.31f, 0.15f, 0.10f}},
                             Known{"cream", {0.98f, 0.90f, 0.73f}}, Known{"potato", {0.77f, 0.62f, 0.21f}},
                             Known{"skin1", {0.44f, 0.22f, 0.13f}}, Known{"skin2", {0.63f, 0.44f, 0.34f}},
                             Known{"whole_milk", {0.91f, 0.88f, 0.76f}}}) {
    const auto medium = std::ranges::find(kMeasuredMedia, known.name, &MeasuredMedium::name);
    ASSERT_NE(medium, kMeasuredMedia.end());
    for (int c = 0; c < 3; ++c) {
      const float alpha = medium->reduced_sigma_s[c] / (medium->reduced_sigma_s[c] + medium->sigma_a[c]);
      EXPECT_NEAR(DipoleProfile::total_reflectance(alpha, 1.3f), known.reflectance[c], 0.03f) << known.name;
    }
  }
}

TEST(DipoleProfile, IsThatOfThePaperButForTheTail) {
  for (const float color : {0.05f, 0.4f, 0.8f, 0.97f}) {
    const DipoleProfile profile(color, 0.3f, 1.4f);
    const auto alpha = static_cast<double>(DipoleProfile::reduced_albedo(color, 1.4f));
    for (const float share : {0.0f, 0.001f, 0.1f, 0.5f, 0.99f}) {
      const float r = share * profile.end();
      const double exact = dipole_reflectance(static_cast<double>(r), alpha, 0.3,
                                              static_cast<double>(DipoleProfile::boundary_term(1.4f)));
      EXPECT_NEAR(static_cast<double>(color * profile.pdf(r)) / exact, 1, 2e-4) << color << ' ' << r;
    }
  }
}

TEST(BurleyProfile, IntegratesToTheAlbedo) {
  for (const double a : {0.02, 0.5, 0.9}) {
    const double length = 0.3, s = 1.9 - a + 3.5 * (a - 0.8) * (a - 0.8);
    auto exact = [&](double r) {
      return a * s / (8 * std::numbers::pi * length * r) *
             (std::exp(-s * r / length) + std::exp(-s * r / (3 * length)));
    };
    EXPECT_NEAR(over_disc(exact, 90 * length / s), a, 1e-6);
    const BurleyProfile profile(static_cast<float>(a), static_cast<float>(length));
    for (const float share : {1e-6f, 0.01f, 0.3f, 0.999f}) {
      const float r = share * profile.end();
      EXPECT_NEAR(a * static_cast<double>(profile.pdf(r)) / exact(static_cast<double>(r)), 1, 2e-4);
    }
  }
}

/// pdf is that of cdf, which ends at 1; samples follow it: a chi-square test over shares of equal
/// probability.
template <class Profile>
void expect_samples_follow(const Profile& profile, std::uint64_t salt, int tests) {
  const double end = static_cast<double>(profile.end());
  EXPECT_NEAR(static_cast<double>(profile.cdf(profile.end())), 1, 1e-5);
  for (const double share : {0.003, 0.1, 0.6, 1.0}) {
    const double sum = over_disc(
        [&](double r) { return static_cast<double>(profile.pdf(static_cast<float>(r))); }, share * end);
    EXPECT_NEAR(sum, static_cast<double>(profile.cdf(static_cast<float>(share * end))), 1e-4);
  }
  constexpr int kBins = 64, kDraws = 200000;
  std::vector<double> counts(kBins), expected(kBins, static_cast<double>(kDraws) / kBins);
  std::mt19937_64 random(hash_combine(fresh_seed(), salt));
  for (int i = 0; i < kDraws; ++i) {
    const float u = to_unit_float(static_cast<std::uint32_t>(random() >> 32));
    const float r = profile.sample(u);
    ASSERT_TRUE(r >= 0 && r <= profile.end() * (1 + 1e-5f)) << r;
    const auto bin = static_cast<std::size_t>(profile.cdf(r) * kBins);
    ++counts[std::min<std::size_t>(bin, kBins - 1)];
  }
  EXPECT_GT(chi_square_test(counts, expected).p_value, sidak_threshold(tests)) << seed_note();
}

TEST(BurleyProfile, SamplesFollowThePdf) {
  std::uint64_t salt = 0;
  for (const float albedo : {0.0f, 0.5f, 1.0f})
    for (const float length : {0.01f, 3.0f}) expect_samples_follow(BurleyProfile(albedo, length), salt++, 6);
}

TEST(DipoleProfile, SamplesFollowThePdf) {
  std::uint64_t salt = 100;
  for (const float albedo : {0.01f, 0.5f, 0.9f, 1.0f})
    for (const float ior : {1.0f, 1.5f}) expect_samples_follow(DipoleProfile(albedo, 0.2f, ior), salt++, 8);
}

} // namespace
} // namespace candela::test
