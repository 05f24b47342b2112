#include "materials/bsdf_lanes.h"
#include "support/patterns.h"

#include <gtest/gtest.h>

#include <vector>

namespace candela {
namespace {

/// One of each of some types, mixed so that no two neighbours are of one type.
std::vector<Bsdf> mixed_closures(std::size_t count) {
  const Bsdf kinds[] = {Diffuse{Spectrum(0.7f)}, Ggx{Spectrum(0.9f), 0.3f}, Dielectric{}, Plastic{},
                        Mirror{}};
  std::vector<Bsdf> closures;
  for (std::size_t k = 0; k < count; ++k) closures.push_back(kinds[k % std::size(kinds)]);
  return closures;
}

TEST(BsdfLanes, VisitsEachClosureOnceByItsOwnType) {
  const std::vector<Bsdf> closures = mixed_closures(64);
  std::vector<const Bsdf*> pointers;
  for (const Bsdf& bsdf : closures) pointers.push_back(&bsdf);
  // All that is called is inlined for each type, so the test itself is not within.
  std::vector<int> visits(closures.size(), 0), own(closures.size(), 0);
  for_each_closure(pointers, [&](const auto& closure, std::size_t k) {
    using Closure = std::remove_cvref_t<decltype(closure)>;
    own[k] = std::get_if<Closure>(pointers[k]) == &closure ? 1 : 0;
    ++visits[k];
  });
  EXPECT_EQ(own, std::vector<int>(closures.size(), 1));
  EXPECT_EQ(visits, std::vector<int>(closures.size(), 1));
}

TEST(BsdfLanes, SamplesWhatEachClosureSamplesAlone) {
  const std::vector<Bsdf> closures = mixed_closures(60);
  std::vector<const Bsdf*> pointers;
  for (const Bsdf& bsdf : closures) pointers.push_back(&bsdf);
  test::Random random(1);
  std::vector<vec3> wo;
  std::vector<BsdfU> u;
  for (std::size_t k = 0; k < closures.size(); ++k) {
    wo.push_back(glm::normalize(vec3(random.in_square(1), 0.1f + random())));
    u.emplace_back(vec3(random.in_square(1) + 0.5f, random()));
  }
  for (DirectionSampling how : {DirectionSampling::bsdf, DirectionSampling::cosine}) {
    std::vector<std::optional<BsdfSample>> samples(closures.size());
    std::size_t called = 0;
    sample_directions(
        pointers, how, [&](std::size_t k) { return wo[k]; }, [&](std::size_t k) { return u[k]; },
        [&](std::size_t k, const std::optional<BsdfSample>& s) { samples[k] = s, ++called; });
    EXPECT_EQ(called, closures.size());
    for (std::size_t k = 0; k < closures.size(); ++k) {
      const auto alone = sample_direction(closures[k], wo[k], u[k], how);
      ASSERT_EQ(samples[k].has_value(), alone.has_value()) << k;
      if (!alone) continue;
      EXPECT_EQ(samples[k]->wi, alone->wi) << k;
      EXPECT_EQ(samples[k]->weight, alone->weight) << k;
      EXPECT_EQ(samples[k]->pdf, alone->pdf) << k;
      EXPECT_EQ(samples[k]->eta, alone->eta) << k;
      EXPECT_EQ(samples[k]->delta, alone->delta) << k;
    }
  }
}

} // namespace
} // namespace candela
