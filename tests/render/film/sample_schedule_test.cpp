// Every pixel gets every sample index once, for any sequence of regions.

#include "render/film/sample_schedule.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace candela {
namespace {

constexpr int kWidth = 37, kHeight = 23;

struct Counter {
  std::vector<std::uint32_t> next = std::vector<std::uint32_t>(kWidth * kHeight, 1);

  void take(const SampleSchedule::Job& job) {
    ASSERT_LT(job.begin, job.end);
    for (int y = job.window.y; y < job.window.y + job.window.height; ++y)
      for (int x = job.window.x; x < job.window.x + job.window.width; ++x) {
        auto& n = next[static_cast<std::size_t>(y * kWidth + x)];
        ASSERT_EQ(n, job.begin) << "a sample was left out or taken twice at " << x << ' ' << y;
        n = job.end;
      }
  }
};

TEST(SampleSchedule, OnlyTheRegionIsSampled) {
  SampleSchedule schedule;
  schedule.reset({0, 0, kWidth, kHeight}, 1);
  schedule.set_region({5, 6, 10, 4});
  const SampleSchedule::Job job = schedule.next(8);
  EXPECT_EQ(job.window.x, 5);
  EXPECT_EQ(job.window.y, 6);
  EXPECT_EQ(job.window.width, 10);
  EXPECT_EQ(job.window.height, 4);
  EXPECT_EQ(job.begin, 1u);
  EXPECT_EQ(job.end, 9u);
  schedule.done(job);
  EXPECT_EQ(schedule.samples(), 9u);
  schedule.set_region({});
  EXPECT_EQ(schedule.samples(), 1u) << "the rest is behind";
}

TEST(SampleSchedule, RegionsComeAndGoAndAllIsEvenInTheEnd) {
  std::mt19937_64 random(test::fresh_seed());
  SCOPED_TRACE(test::seed_note());
  auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
  SampleSchedule schedule;
  schedule.reset({0, 0, kWidth, kHeight}, 1);
  Counter counter;
  for (int i = 0; i < 60; ++i) {
    schedule.set_region({pick(-9, kWidth), pick(-9, kHeight), pick(0, kWidth), pick(0, kHeight)});
    for (int pass = pick(0, 4); pass > 0; --pass) {
      const auto job = schedule.next(static_cast<std::uint32_t>(pick(1, 5)));
      ASSERT_NO_FATAL_FAILURE(counter.take(job));
      schedule.done(job);
    }
  }
  schedule.set_region({});
  const std::uint32_t most = *std::ranges::max_element(counter.next);
  for (int guard = 0; schedule.samples() < most && guard < 100000; ++guard) {
    const auto job = schedule.next(64);
    ASSERT_LE(job.end, most) << "nobody runs ahead while others catch up";
    ASSERT_NO_FATAL_FAILURE(counter.take(job));
    schedule.done(job);
  }
  for (std::uint32_t n : counter.next) EXPECT_EQ(n, most);
  const auto job = schedule.next(3);
  EXPECT_EQ(job.window.width, kWidth) << "even again, the film is one piece";
  EXPECT_EQ(job.window.height, kHeight);
}

} // namespace
} // namespace candela
