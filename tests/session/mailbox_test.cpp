// Requests, and what the render thread gets of them.

#include "session/mailbox.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

struct Box {
  SessionMonitor monitor;
  std::unique_lock<std::mutex> lock = monitor.lock();
  Mailbox mailbox;
  Document document = test::cornell_flush(8, 8, 1, false).document;
};

TEST(Mailbox, TheLatestDocumentWinsWithTheHeaviestConsequence) {
  Box b;
  EXPECT_FALSE(b.mailbox.take(b.lock));
  EXPECT_TRUE(b.mailbox.submit(b.lock, b.document).restarts) << "the first one always does";
  ASSERT_TRUE(b.mailbox.take(b.lock));
  EXPECT_FALSE(b.mailbox.outdated());

  b.document.scene.camera.position.x += 1;
  const Mailbox::Receipt moved = b.mailbox.submit(b.lock, b.document);
  EXPECT_TRUE(moved.restarts);
  EXPECT_TRUE(b.mailbox.outdated()) << "the pass in flight";
  b.document.settings.display.exposure = 1;
  const Mailbox::Receipt toned = b.mailbox.submit(b.lock, b.document);
  EXPECT_FALSE(toned.restarts);
  EXPECT_EQ(toned.generation, moved.generation + 1);
  EXPECT_EQ(b.mailbox.restarting(b.lock), moved.generation);
  EXPECT_TRUE(b.mailbox.has_restart(b.lock)) << "the camera has moved all the same";

  const auto delivery = b.mailbox.take(b.lock);
  ASSERT_TRUE(delivery);
  EXPECT_EQ(delivery->generation, toned.generation);
  EXPECT_GE(delivery->consequence, Invalidates::image);
  EXPECT_TRUE(delivery->document == b.document);
  EXPECT_FALSE(b.mailbox.outdated());
  EXPECT_FALSE(b.mailbox.take(b.lock)) << "once";

  b.document.settings.display.exposure = 2;
  b.mailbox.submit(b.lock, b.document);
  EXPECT_FALSE(b.mailbox.has_restart(b.lock));
  EXPECT_LT(b.mailbox.take(b.lock)->consequence, Invalidates::image) << "what was taken is forgotten";
}

TEST(Mailbox, APauseLetsFirstPassesAndStepsThrough) {
  Box b;
  EXPECT_TRUE(b.mailbox.may_render(b.lock, true));
  b.mailbox.pause(b.lock, true);
  EXPECT_TRUE(b.mailbox.hold()) << "the pass in flight waits";
  EXPECT_FALSE(b.mailbox.may_render(b.lock, true));
  EXPECT_TRUE(b.mailbox.may_render(b.lock, false)) << "an edit's first pass";
  EXPECT_FALSE(b.mailbox.take_step(b.lock));
  b.mailbox.step(b.lock);
  b.mailbox.step(b.lock);
  EXPECT_TRUE(b.mailbox.may_render(b.lock, true));
  b.mailbox.begin_pass(b.lock);
  EXPECT_FALSE(b.mailbox.hold());
  EXPECT_TRUE(b.mailbox.take_step(b.lock));
  EXPECT_TRUE(b.mailbox.has_step(b.lock));
  b.mailbox.pause(b.lock, false);
  EXPECT_FALSE(b.mailbox.has_step(b.lock)) << "steps that were not taken are forgotten";
  EXPECT_FALSE(b.mailbox.take_step(b.lock));
  EXPECT_TRUE(b.mailbox.may_render(b.lock, true));
}

TEST(Mailbox, TheNewestRegionIsTakenOnce) {
  Box b;
  EXPECT_FALSE(b.mailbox.take_region(b.lock));
  b.mailbox.set_region(b.lock, {1, 2, 3, 4});
  b.mailbox.set_region(b.lock, {5, 6, 7, 8});
  EXPECT_TRUE(b.mailbox.hold());
  EXPECT_EQ(b.mailbox.take_region(b.lock), (CropWindow{5, 6, 7, 8}));
  EXPECT_FALSE(b.mailbox.take_region(b.lock));
  EXPECT_FALSE(b.mailbox.has_region(b.lock));
}

TEST(Mailbox, ClosingEndsThePassInFlight) {
  Box b;
  b.mailbox.close(b.lock);
  EXPECT_TRUE(b.mailbox.closed(b.lock));
  EXPECT_TRUE(b.mailbox.closing());
  EXPECT_TRUE(b.mailbox.outdated());
}

} // namespace
} // namespace candela
