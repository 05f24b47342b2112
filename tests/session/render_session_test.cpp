// The interactive engine: what restarts it, and that its picture is the headless one. Waits are for events,
// with limits only against hanging.

#include "session/session_testing.h"
#include "support/materials.h"

#include <chrono>
#include <thread>

namespace candela {
namespace {

using test::color;

using test::headless;
using test::kPatience;
using test::shows;
using test::small_cornell;

TEST(RenderSession, PictureIsTheHeadlessRenderBitForBit) {
  for (int threads : {1, 2, 3}) {
    SessionOptions options;
    options.threads = threads;
    RenderSession session(options);
    Document d = small_cornell();
    std::uint64_t generation = session.submit(d);
    ASSERT_TRUE(session.wait_finished(kPatience));
    auto frame = session.latest();
    EXPECT_EQ(frame->generation, generation);
    EXPECT_EQ(frame->spp, 4);
    EXPECT_EQ(frame->coarseness, 1);
    EXPECT_TRUE(frame->linear == headless(d)) << threads << " threads";
  }
}

// Each edit comes long before the first full pass of the previous one, and yet has a picture: coarse, but
// complete.
TEST(RenderSession, DraggingShowsACoarseImageOfEveryEdit) {
  RenderSession session;
  Document d = small_cornell(0, 400, 300);
  d.settings.path.light_samples = 64; // a full pass takes long
  bool coarsest_seen = false;
  for (int i = 0; i < 5; ++i) {
    d.scene.camera.position.x = 278.0f + static_cast<float>(i);
    std::uint64_t generation = session.submit(d);
    std::shared_ptr<const DisplayImage> picture;
    auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience);
    while (!(picture = session.display()) || picture->frame->generation != generation) {
      ASSERT_LT(std::chrono::steady_clock::now(), give_up) << "edit " << i << " was never shown";
      std::this_thread::yield();
    }
    EXPECT_EQ(picture->frame->spp, 0);
    coarsest_seen |= picture->frame->coarseness == 8;
    // The back wall is lit everywhere: no pixel may be black.
    for (int x = 180; x < 220; ++x)
      EXPECT_GT(picture->frame->linear[80 * 400 + static_cast<std::size_t>(x)].x, 0);
    EXPECT_GE(session.status().first_image_ms, 0);
  }
  EXPECT_TRUE(coarsest_seen);
}

TEST(RenderSession, ManyEditsEndInTheLastOne) {
  RenderSession session;
  Document d = small_cornell();
  for (int i = 0; i < 50; ++i) {
    d.scene.camera.position.x = 278.0f + static_cast<float>(i);
    session.submit(d);
  }
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_TRUE(session.latest()->linear == headless(d));
  EXPECT_EQ(session.status().submitted, 50u);
  EXPECT_LE(session.status().restarts, 50u);
}

TEST(RenderSession, DisplayChangesRetoneWithoutRestart) {
  RenderSession session;
  Document d = small_cornell();
  ASSERT_TRUE(shows(session, d));
  auto before = session.display();
  std::uint64_t restarts = session.status().restarts;
  d.settings.display.exposure = 2;
  ASSERT_TRUE(shows(session, d));
  auto after = session.display();
  EXPECT_EQ(session.status().restarts, restarts);
  EXPECT_EQ(after->frame, before->frame);
  EXPECT_NE(after->rgba, before->rgba);
}

TEST(RenderSession, MoreSamplesContinueInsteadOfRestarting) {
  RenderSession session;
  Document d = small_cornell(2);
  ASSERT_TRUE(shows(session, d));
  d.settings.stop.spp = 7;
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 1u);
  EXPECT_EQ(session.latest()->spp, 7);
  EXPECT_TRUE(session.latest()->linear == headless(d));
}

TEST(RenderSession, AMaterialEditRestartsAndShowsItself) {
  RenderSession session;
  Document d = small_cornell();
  ASSERT_TRUE(shows(session, d));
  color(d.scene.materials[0], "diffuse") = {0.1f, 0.2f, 0.9f};
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 2u);
  EXPECT_TRUE(session.latest()->linear == headless(d));
}

TEST(RenderSession, EmissionEditRebuildsLights) {
  RenderSession session;
  Document d = small_cornell();
  ASSERT_TRUE(shows(session, d));
  d.scene.materials[0].emission = vec3{0.5f, 0.5f, 0.5f};
  LightDesc bulb;
  bulb.model = PointLightModel{.position = {278, 273, 279}};
  bulb.color = vec3(1e5f);
  d.scene.lights.push_back(bulb);
  ASSERT_TRUE(shows(session, d));
  EXPECT_TRUE(session.latest()->linear == headless(d));
}

TEST(RenderSession, FilmSizesFromOnePixelUp) {
  RenderSession session;
  for (auto [w, h] : {std::pair{1, 1}, {7, 3}, {8, 8}, {9, 17}, {130, 2}}) {
    Document d = small_cornell(3, w, h);
    ASSERT_TRUE(shows(session, d));
    auto picture = session.display();
    EXPECT_EQ(picture->width, w);
    EXPECT_EQ(picture->height, h);
    EXPECT_TRUE(picture->frame->linear == headless(d)) << w << "x" << h;
  }
}

TEST(RenderSession, WaitsEndAndDestructionCancels) {
  Document d = small_cornell(0, 400, 300); // never finished
  RenderSession session;
  session.submit(d);
  EXPECT_FALSE(session.wait_finished(0.2));
  // The destructor must return; otherwise the test's time limit fails.
}

TEST(RenderSession, PicksWhatIsUnderAPixel) {
  RenderSession session;
  EXPECT_FALSE(session.pick({0, 0}));
  Document d = small_cornell(1, 64, 64);
  ASSERT_TRUE(shows(session, d));
  auto hit = session.pick({32, 20}); // the back wall above the blocks
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->position.z, 559.2f, 0.1f);
  EXPECT_NEAR(hit->view_depth, 1359.2f, 0.2f);
  EXPECT_EQ(hit->instance, 1);
  EXPECT_FALSE(session.pick({0, 0})); // past the front edge of the box
}

TEST(RenderSession, CountsOnlyItsOwnAccumulation) {
  RenderSession session;
  Document d = small_cornell(3);
  ASSERT_TRUE(shows(session, d));
  SessionStatus status = session.status();
  EXPECT_EQ(status.rays.samples, 3u * 61u * 43u);
  EXPECT_EQ(status.progress, 1);
  EXPECT_EQ(status.phase, SessionPhase::finished);
  EXPECT_EQ(status.nonfinite, 0u);
  EXPECT_GT(status.rays.closest, status.rays.samples);
}

TEST(RenderSession, NothingOfAnEarlierImageOrSizeIsLeftInTheNextOne) {
  RenderSession session;
  int seed = 0;
  for (const ivec2 size : {ivec2(40, 30), ivec2(64, 48), ivec2(64, 48), ivec2(17, 9), ivec2(50, 33)}) {
    Document document = small_cornell(3, size.x, size.y);
    document.settings.sampler.seed = ++seed;
    ASSERT_TRUE(shows(session, document));
    EXPECT_EQ(session.latest()->linear, headless(document)) << size.x << " x " << size.y;
  }
}

} // namespace
} // namespace candela
