// The headless render: stopping criteria, and independence of the result from the passes.

#include "core/error.h"
#include "core/progress.h"
#include "session/session_testing.h"

#include <gtest/gtest.h>

#include <thread>

namespace candela {
namespace {

TEST(OfflineRender, StopsAtTheSampleCount) {
  Document d = test::cornell_flush(33, 17, 5, false).document;
  OfflineResult r = render_document(d);
  EXPECT_EQ(r.spp, 5);
  EXPECT_EQ(r.rays.samples, 5u * 33u * 17u);
  EXPECT_EQ(r.film.count(32, 16), 5);
  EXPECT_FALSE(r.interrupted);
}

TEST(OfflineRender, StopsAtTheTime) {
  Document d = test::cornell_flush(33, 17, 0, false).document;
  d.settings.stop.time = 0.25f;
  OfflineResult r = render_document(d);
  EXPECT_GE(r.spp, 1);
  EXPECT_GE(r.render_seconds, 0.25);
}

TEST(OfflineRender, StopsAtTheTimeWithinTheFirstPassAndFillsWhatIsMissing) {
  Document d = test::cornell_flush(2048, 2048, 0, true).document;
  d.settings.path.light_samples = 16;
  d.settings.stop.time = 0.3f;
  const OfflineResult r = render_document(d);
  if (r.spp > 0) GTEST_SKIP() << "this machine renders 4 million pixels in the time";
  EXPECT_FALSE(r.interrupted);
  EXPECT_GT(r.missing, 0);
  // For any amount of work: a pixel is empty only if the one that represents its block is.
  int wrong = 0;
  for (int y = 0; y < 2048; ++y)
    for (int x = 0; x < 2048; ++x)
      wrong +=
          r.film.count(x, y) > 1 || (r.film.count(x, y) == 0 && r.film.count(x / 32 * 32, y / 32 * 32) > 0);
  EXPECT_EQ(wrong, 0);
}

TEST(OfflineRender, IsInterruptedWithinABatchOfPaths) {
  Document limited = test::slow_document();
  limited.settings.stop.spp = 1000000;
  std::atomic<bool> stop{false};
  OfflineOptions options;
  options.stop = &stop;
  std::jthread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop = true;
  });
  EXPECT_TRUE(render_document(limited, options).interrupted);
}

TEST(OfflineRender, IsInterruptedWhileTheSceneIsBuilt) {
  const std::atomic<bool> stop{true};
  OfflineOptions options;
  options.stop = &stop;
  EXPECT_THROW(render_document(test::cornell_flush(8, 8, 1, true).document, options), Cancelled);
}

TEST(OfflineRender, RefusesToRunForEver) {
  Document d = test::cornell_flush(8, 8, 0, false).document;
  try {
    render_document(d);
    FAIL() << "it has no stopping criterion";
  } catch (const Error& e) { EXPECT_EQ(e.code(), ExitCode::usage); }
}

TEST(OfflineRender, KeepsWholeSamplesWhenInterrupted) {
  Document d = test::cornell_flush(64, 64, 1000, true).document;
  std::atomic<bool> stop{false};
  OfflineOptions options;
  options.stop = &stop;
  options.progress = [&](const OfflineProgress& p) { stop = p.spp >= 3; };
  OfflineResult r = render_document(d, options);
  EXPECT_TRUE(r.interrupted);
  EXPECT_GE(r.spp, 3);
  d.settings.stop.spp = r.spp;
  Film expected = render_document(d).film;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      ASSERT_GE(r.film.count(x, y), r.spp);
      if (r.film.count(x, y) == r.spp) { EXPECT_EQ(r.film.mean(x, y), expected.mean(x, y)); }
    }
}

TEST(OfflineRender, CropRendersNothingElse) {
  Document d = test::cornell_flush(64, 48, 2, true).document;
  OfflineOptions options;
  options.pass.crop = {10, 20, 17, 9};
  OfflineResult r = render_document(d, options);
  EXPECT_EQ(r.rays.samples, 2u * 17u * 9u);
  Film whole = render_document(d).film;
  for (int y = 20; y < 29; ++y)
    for (int x = 10; x < 27; ++x) EXPECT_EQ(r.film.mean(x - 10, y - 20), whole.mean(x, y));
  EXPECT_EQ(r.film.width(), 17) << "a film of the window alone";
  EXPECT_EQ(r.film.height(), 9);
  EXPECT_EQ(r.film.origin(), ivec2(10, 20));
}

TEST(OfflineRender, TheNoiseOfACropIsThatOfItsPixels) {
  Document d = test::cornell_flush(64, 48, 8, true).document;
  OfflineOptions options;
  options.pass.crop = {10, 20, 17, 9};
  const OfflineResult r = render_document(d, options);
  double sum = 0;
  for (int y = 20; y < 29; ++y)
    for (int x = 10; x < 27; ++x) sum += r.film.relative_variance(x - 10, y - 20);
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(r.noise, std::sqrt(sum / (17 * 9)), 1e-9);
}

} // namespace
} // namespace candela
