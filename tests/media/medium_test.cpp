#include "media/medium.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

const Sampler kSampler(SamplerType::independent, 1);

TEST(HomogeneousMedium, FollowsBeerAndLambert) {
  const Medium medium = HomogeneousMedium{{0.1f, 1, 2.5f}};
  const Ray ray{{1, 2, 3}, 0, {0, 7, 0}, kInfinity}; // of any length: the distance is in scene units
  const Spectrum part = transmittance(ray, 0.7f, medium, kSampler).value,
                 rest = transmittance(ray, 1.3f, medium, kSampler).value,
                 whole = transmittance(ray, 2, medium, kSampler).value;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(part[c] * rest[c], whole[c], 1e-6f);
    EXPECT_NEAR(whole[c], std::exp(-2 * std::get<HomogeneousMedium>(medium).sigma_a[c]), 1e-6f);
  }
  EXPECT_EQ(transmittance(ray, 0, medium, kSampler).value, Spectrum(1));
}

TEST(HomogeneousMedium, OnAnInfiniteWayAllOrNothingIsLeft) {
  EXPECT_EQ(transmittance({}, kInfinity, HomogeneousMedium{{1, 0, 1e-30f}}, kSampler).value,
            Spectrum(0, 1, 0));
}

} // namespace
} // namespace candela::test
