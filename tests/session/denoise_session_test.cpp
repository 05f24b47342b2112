// Denoising in a session, concurrently with the render.

#include "session/session_testing.h"

#include <thread>

namespace candela {
namespace {

using test::kPatience;
using test::shows;
using test::small_cornell;

Document denoised_cornell(int spp) {
  Document d = small_cornell(spp);
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
  Document d = denoised_cornell(5);
  ASSERT_TRUE(shows(session, d));
  auto picture = session.display();
  ASSERT_TRUE(picture->denoised);
  EXPECT_EQ(picture->denoised->spp, 5);
  EXPECT_TRUE(picture->denoised->linear == denoised_headless(d));
  EXPECT_TRUE(picture->frame->linear == render_document(d).film.image().pixels) << "the render is as it was";
}

TEST(RenderSession, DenoisingIsSwitchedWithoutARestart) {
  RenderSession session;
  Document d = denoised_cornell(4);
  ASSERT_TRUE(shows(session, d));
  auto clean = session.display();
  d.settings.display.denoise = false;
  ASSERT_TRUE(shows(session, d));
  auto noisy = session.display();
  EXPECT_FALSE(noisy->denoised);
  EXPECT_NE(noisy->rgba, clean->rgba);
  d.settings.display.denoise = true;
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.display()->rgba, clean->rgba);
  EXPECT_EQ(session.status().restarts, 1u);
}

TEST(RenderSession, DenoisesWhatIsSwitchedOnAfterwards) {
  RenderSession session;
  Document d = denoised_cornell(4);
  d.settings.display.denoise = false;
  ASSERT_TRUE(shows(session, d));
  EXPECT_FALSE(session.display()->denoised);
  d.settings.display.denoise = true;
  ASSERT_TRUE(shows(session, d));
  EXPECT_TRUE(session.display()->denoised);
}

TEST(RenderSession, NeverShowsTheDenoisedImageOfAnotherScene) {
  RenderSession session;
  Document d = denoised_cornell(3);
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
  Document d = denoised_cornell(4);
  d.settings.view = View::normal;
  ASSERT_TRUE(shows(session, d));
  EXPECT_FALSE(session.display()->denoised);
}

TEST(RenderSession, EndsWhileItDenoises) {
  for (int i = 0; i < 5; ++i) {
    RenderSession session;
    session.submit(denoised_cornell(0));
    while (session.status().spp < 2 + i) std::this_thread::yield();
  }
}

} // namespace
} // namespace candela
