// Integration with each sampler: unbiased at any sample count, with less error than independent samples.

#include "sampler_draws.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <utility>

namespace candela::test {
namespace {

/// Mean of f over the first `samples` of a pixel.
template <class F>
double estimate(Sampler& sampler, uvec2 pixel, std::uint32_t samples, F f) {
  double sum = 0;
  for (std::uint32_t s = 0; s < samples; ++s) {
    sampler.start(pixel, s);
    sum += f(sampler);
  }
  return sum / samples;
}

/// Mean squared error of that over many pixels.
template <class F>
double mean_squared_error(SamplerType type, std::uint32_t samples, double exact, F f,
                          std::uint32_t pixels = 400) {
  Sampler sampler(type, fresh_seed() + 3, 16);
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    double error = estimate(sampler, independent_pixel(type, pixel, 1), samples, f) - exact;
    sum += error * error;
  }
  return sum / pixels;
}

double smooth(const Sampler& s) {
  vec2 p = s.get_2d(Dimension::lens);
  return std::exp(double(p.x)) * std::sin(std::numbers::pi * double(p.y));
}
constexpr double kSmoothIntegral = (std::numbers::e - 1) * 2 * std::numbers::inv_pi;

TEST(SamplerIntegrationStatistical, AnyCountIsUnbiased) {
  SCOPED_TRACE(seed_note());
  // Over two dimensions and one draw in 1-D, symmetric in nothing.
  auto f = [](const Sampler& s) {
    vec2 p = s.get_2d(Dimension::bsdf_direction);
    return smooth(s) * (0.2 + std::sqrt(double(p.x)) * double(p.y) * double(p.y)) *
           (double(s.get_1d(Dimension::bsdf_lobe)) < 0.3 ? 2.0 : 0.5);
  };
  const double exact = kSmoothIntegral * (0.2 + 2.0 / 9.0) * 0.95;
  const std::uint32_t counts[] = {1, 3, 7, 100};
  for (SamplerType type : kSamplerTypes) {
    Sampler sampler(type, fresh_seed() + 11, 3);
    for (std::uint32_t n : counts) {
      RunningStatistics statistics;
      for (std::uint32_t trial = 0; trial < 200000 / n; ++trial)
        statistics.add(estimate(sampler, independent_pixel(type, trial % 700, trial / 700), n, f));
      EXPECT_GT(z_test(statistics, exact, 1e-6), sidak_threshold(kSamplerTypeCount * 4))
          << static_cast<int>(type) << ' ' << n << ' ' << statistics.mean() << ' ' << exact;
    }
  }
}

TEST(SamplerIntegrationStatistical, StructureConvergesFasterOnASmoothIntegral) {
  SCOPED_TRACE(seed_note());
  double independent = mean_squared_error(SamplerType::independent, 256, kSmoothIntegral, smooth);
  // In theory a factor of about 256 for a jittered grid, 256^2 for scrambled nets, and 256 for a lattice (it
  // wants periodic functions), but for constants. 256 is not a length of Halton's runs.
  const std::pair<SamplerType, double> factors[] = {
      {SamplerType::stratified, 30}, {SamplerType::halton, 40},   {SamplerType::sobol, 1000},
      {SamplerType::pmj02, 1000},    {SamplerType::lattice, 200}, {SamplerType::blue_noise, 1000}};
  for (auto [type, factor] : factors)
    EXPECT_LT(mean_squared_error(type, 256, kSmoothIntegral, smooth), independent / factor)
        << static_cast<int>(type);
  // In 1-D, too, and on a count that is no power of two.
  auto line = [](const Sampler& s) { return std::exp(double(s.get_1d(Dimension::opacity))); };
  independent = mean_squared_error(SamplerType::independent, 300, std::numbers::e - 1, line);
  for (SamplerType type : kSamplerTypes) {
    if (type == SamplerType::independent || type == SamplerType::stratified) continue;
    EXPECT_LT(mean_squared_error(type, 300, std::numbers::e - 1, line), independent / 30)
        << static_cast<int>(type);
  }
}

TEST(SamplerIntegrationStatistical, ALatticeIsBestForPeriodicFunctions) {
  SCOPED_TRACE(seed_note());
  auto periodic = [](const Sampler& s) {
    vec2 p = s.get_2d(Dimension::lens) * (2 * kPi);
    return std::exp(std::cos(double(p.x)) + std::sin(double(p.y)));
  };
  double exact = 1.2660658777520084 * 1.2660658777520084; // I_0(1)^2
  EXPECT_LT(mean_squared_error(SamplerType::lattice, 256, exact, periodic),
            mean_squared_error(SamplerType::sobol, 256, exact, periodic) / 30);
}

TEST(SamplerIntegrationStatistical, PaddedDimensionsAreNoWorseThanIndependent) {
  SCOPED_TRACE(seed_note());
  // The product's variance is all in the interaction of dimensions that were not made to fit each other: were
  // they to run through their intervals in the same order, the error would be 64 times as large. As aligned
  // runs stay together, digit k of the one and digit k of the other still have twice the variance, of which
  // they hold 16^-k: in all 1 + (1/15) / (1/9) = 1.6 times as much as independent numbers in base 2.
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      auto product = [=](const Sampler& s) {
        return (double(s.get_2d(Dimension::lens)[a]) - 0.5) * (double(s.get_2d(Dimension::film)[b]) - 0.5);
      };
      for (SamplerType type : kSamplerTypes)
        EXPECT_LT(mean_squared_error(type, 64, 0, product, 4000), 2.0 / (144 * 64))
            << static_cast<int>(type) << ' ' << a << b;
    }
  }
}

/// Mean energy of an image's pixels, after a 3 x 3 box has passed over it three times: what lies at low
/// frequencies. The image repeats at its edges.
double low_frequency_energy(std::vector<double> image, std::size_t side) {
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<double> from = image;
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        double sum = 0;
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t i = 0; i < 3; ++i)
            sum += from[(y + j + side - 1) % side * side + (x + i + side - 1) % side];
        image[y * side + x] = sum / 9;
      }
    }
  }
  double energy = 0;
  for (double v : image) energy += v * v;
  return energy / double(image.size());
}

TEST(SamplerIntegrationStatistical, BlueNoiseKeepsTheErrorOutOfLowFrequencies) {
  SCOPED_TRACE(seed_note());
  constexpr std::uint32_t kSide = 64;
  for (std::uint32_t samples : {1u, 2u, 4u, 16u}) {
    auto energy = [&](SamplerType type) {
      double sum = 0;
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Sampler sampler(type, fresh_seed() + 100 * seed);
        std::vector<double> error;
        for (std::uint32_t y = 0; y < kSide; ++y)
          for (std::uint32_t x = 0; x < kSide; ++x)
            error.push_back(estimate(sampler, {x, y}, samples, smooth) - kSmoothIntegral);
        sum += low_frequency_energy(error, kSide);
      }
      return sum / 8;
    };
    // Some 150 independent low frequencies a seed: 8 % standard deviation of the sum of eight at most.
    EXPECT_LT(energy(SamplerType::blue_noise), energy(SamplerType::sobol) * 0.5) << samples;
  }
}

} // namespace
} // namespace candela::test
