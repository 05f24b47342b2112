// A session that denoises: beside the render, never instead of it.

#include "session/offline_render.h"
#include "session/render_session.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <thread>

namespace candela {
namespace {

constexpr double kPatience = 120; // seconds before a wait counts as hanging

Document small_cornell(int spp) {
  Document d = test::cornell_flush(61, 43, spp, true).document;
  d.settings.display.denoise = true;
  return d;
}

std::vector<vec3> denoised_headless(const Document& document) {
  OfflineResult rendered = render_document(document);
  FeatureFilm features(61, 43);
  return denoise_render(noisy_image(rendered.film), rendered.spp, *RenderScene::build(document), document,
                        features)
      ->pixels;
}

TEST(RenderSession, ShowsTheDenoisedImageOfAllSamples) {
  RenderSession session;
  Document d = small_cornell(5);
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  auto picture = session.display();
  ASSERT_TRUE(picture->denoised);
  EXPECT_EQ(picture->denoised->spp, 5);
  EXPECT_TRUE(picture->denoised->linear == denoised_headless(d));
  EXPECT_TRUE(picture->frame->linear == render_document(d).film.image().pixels) << "the render is as it was";
}

TEST(RenderSession, DenoisingIsSwitchedWithoutARestart) {
  RenderSession session;
  Document d = small_cornell(4);
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  auto clean = session.display();
  d.settings.display.denoise = false;
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  auto noisy = session.display();
  EXPECT_FALSE(noisy->denoised);
  EXPECT_NE(noisy->rgba, clean->rgba);
  d.settings.display.denoise = true;
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.display()->rgba, clean->rgba);
  EXPECT_EQ(session.status().restarts, 1u);
}

TEST(RenderSession, DenoisesWhatIsSwitchedOnAfterwards) {
  RenderSession session;
  Document d = small_cornell(4);
  d.settings.display.denoise = false;
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_FALSE(session.display()->denoised);
  d.settings.display.denoise = true;
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_TRUE(session.display()->denoised);
}

TEST(RenderSession, NeverShowsTheDenoisedImageOfAnotherScene) {
  RenderSession session;
  Document d = small_cornell(3);
  for (int i = 0; i < 20; ++i) {
    d.scene.camera.position.x = 278.0f + static_cast<float>(i);
    session.submit(d);
    auto picture = session.display();
    if (picture && picture->denoised) {
      EXPECT_EQ(picture->denoised->accumulation, picture->frame->generation);
    }
  }
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_TRUE(session.display()->denoised->linear == denoised_headless(d));
}

TEST(RenderSession, ShowsOtherViewsAsTheyAre) {
  RenderSession session;
  Document d = small_cornell(4);
  d.settings.view = View::normal;
  session.submit(d);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_FALSE(session.display()->denoised);
}

TEST(RenderSession, EndsWhileItDenoises) {
  for (int i = 0; i < 5; ++i) {
    RenderSession session;
    session.submit(small_cornell(0));
    while (session.status().spp < 2 + i) std::this_thread::yield();
  }
}

} // namespace
} // namespace candela
