// Pause, step, region and build quality, without loss of samples.

#include "session/session_testing.h"

#include <chrono>
#include <thread>

namespace candela {
namespace {

using test::headless;
using test::kPatience;
using test::shows;
using test::slow_document;
using test::small_cornell;

TEST(SessionControl, APauseKeepsThePassesItHasAndResumesToTheSameBits) {
  RenderSession session;
  Document d = small_cornell(0); // never finished by itself
  session.submit(d);
  session.pause(true);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.status().phase, SessionPhase::paused);
  const auto frame = session.latest();
  EXPECT_GE(frame->spp, 1) << "the first pass is shown";
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(session.latest(), frame) << "nothing accumulates";

  d.settings.stop.spp = frame->spp + 5;
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.latest()->spp, frame->spp) << "a later stop does not end the pause";
  session.pause(false);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.status().phase, SessionPhase::finished);
  EXPECT_EQ(session.status().restarts, 1u);
  EXPECT_TRUE(session.latest()->linear == headless(d));
}

TEST(SessionControl, AnEditWhilePausedShowsItsFirstPass) {
  RenderSession session;
  session.pause(true);
  Document d = small_cornell(0);
  ASSERT_TRUE(shows(session, d));
  for (int i = 1; i <= 3; ++i) {
    d.scene.camera.position.x += 3;
    const std::uint64_t generation = session.submit(d);
    ASSERT_TRUE(session.wait_finished(kPatience));
    EXPECT_EQ(session.display()->frame->generation, generation);
    EXPECT_EQ(session.latest()->spp, 1);
    EXPECT_EQ(session.latest()->coarseness, 1);
  }
}

// A pause may come at any point of the render thread's loop: between the test whether to continue and the
// update of the phase, or after that. Tiny passes make each case likely.
TEST(SessionControl, EveryPauseIsReachedAndShowsEverySample) {
  RenderSession session({.threads = 1});
  session.submit(small_cornell(0, 2, 2));
  for (int i = 0; i < 4000; ++i) {
    session.pause(true);
    ASSERT_TRUE(session.wait_finished(240)) << "pause " << i << " is never reached";
    const SessionStatus status = session.status();
    ASSERT_EQ(status.phase, SessionPhase::paused);
    ASSERT_EQ(session.latest()->rays.samples, status.rays.samples) << "pause " << i << " hides samples";
    session.pause(false);
    std::this_thread::sleep_for(std::chrono::microseconds(i % 64));
  }
}

TEST(SessionControl, AStepIsOneSampleAPixel) {
  RenderSession session;
  session.pause(true);
  Document d = small_cornell(0);
  ASSERT_TRUE(shows(session, d));
  for (int spp = 2; spp <= 6; ++spp) {
    session.step();
    ASSERT_TRUE(session.wait_finished(kPatience));
    EXPECT_EQ(session.latest()->spp, spp);
    d.settings.stop.spp = spp;
    EXPECT_TRUE(session.latest()->linear == headless(d));
  }
}

TEST(SessionControl, ARegionAccumulatesAloneAndTheRestCatchesUp) {
  RenderSession session;
  session.pause(true);
  Document d = small_cornell(9);
  ASSERT_TRUE(shows(session, d));
  const auto first = session.latest();
  const CropWindow region{10, 7, 20, 11};
  session.set_region(region);
  session.pause(false);
  ASSERT_TRUE(session.wait_finished(kPatience));
  const std::vector<vec3> whole = headless(d);
  const auto frame = session.latest();
  EXPECT_EQ(frame->spp, 9);
  for (int y = 0; y < 43; ++y)
    for (int x = 0; x < 61; ++x) {
      const bool inside = x >= 10 && x < 30 && y >= 7 && y < 18;
      const auto i = static_cast<std::size_t>(y * 61 + x);
      ASSERT_EQ(frame->linear[i], (inside ? whole : first->linear)[i]) << x << ' ' << y;
    }
  session.set_region({});
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_TRUE(session.latest()->linear == whole);
  EXPECT_EQ(session.status().restarts, 1u);
}

TEST(SessionControl, ARegionBeforeTheFirstDocumentWaitsForIt) {
  RenderSession session;
  session.set_region({1, 1, 5, 5});
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(session.status().phase, SessionPhase::idle);
  Document d = small_cornell(2);
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.latest()->spp, 2);
}

// If a pass were not interrupted, each of these would take many minutes and exceed the tests' time limit.

TEST(SessionControl, AnEditIsTakenInTheMiddleOfAPass) {
  RenderSession session;
  session.submit(slow_document());
  while (session.status().phase != SessionPhase::rendering) std::this_thread::yield();
  const Document d = small_cornell(4);
  ASSERT_TRUE(shows(session, d));
  EXPECT_TRUE(session.latest()->linear == headless(d));
}

TEST(SessionControl, ClosingDoesNotWaitForAPass) {
  for (int i = 0; i < 3; ++i) {
    RenderSession session;
    session.submit(slow_document());
    while (session.status().phase != SessionPhase::rendering) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(30 * i));
  }
}

TEST(SessionControl, APassThatIsHeldIsContinued) {
  Document d = small_cornell(6, 203, 151);
  d.settings.path.light_samples = 16; // a sample a pass
  RenderSession session;
  session.submit(d);
  for (int i = 0; i < 12; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    session.pause(true);
    if (i % 3 == 0) session.set_region({20, 30, 90, 70});
    if (i % 3 == 2) session.set_region({});
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    session.pause(false);
  }
  session.set_region({});
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.latest()->spp, 6);
  EXPECT_TRUE(session.latest()->linear == headless(d));
}

} // namespace
} // namespace candela
