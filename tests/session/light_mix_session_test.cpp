// Light groups that are mixed while a session accumulates.

#include "render/film/film_view.h"
#include "session/session_testing.h"

#include <thread>

namespace candela {
namespace {

using test::headless;
using test::kPatience;
using test::shows;

/// The lamp is in no group, a point light and a sky in one each.
Document lit_cornell(int spp) {
  Document d = test::small_cornell(spp);
  LightDesc key;
  key.model = PointLightModel{.position = {278, 400, 279}};
  key.color = vec3(3e5f, 2e5f, 1e5f);
  key.group = "key";
  LightDesc sky;
  sky.model = ConstantLightModel();
  sky.group = "sky";
  d.scene.lights = {key, sky};
  return d;
}

TEST(RenderSession, MixesLightGroupsWithoutARestart) {
  RenderSession session;
  Document d = lit_cornell(5);
  ASSERT_TRUE(shows(session, d));
  const std::vector<vec3> whole = session.latest()->linear;
  const auto edits = {+[](SceneDesc& s) { light_group(s, "key").on = false; },
                      +[](SceneDesc& s) { light_group(s, "sky").scale = 3; },
                      +[](SceneDesc& s) {
                        light_group(s, "sky").color = {1, 0.2f, 0};
                      },
                      +[](SceneDesc& s) { light_group(s, "key").solo = true; },
                      +[](SceneDesc& s) { light_group(s, "key").on = true; }};
  for (auto edit : edits) {
    edit(d.scene);
    ASSERT_TRUE(shows(session, d));
    const auto frame = session.latest();
    EXPECT_EQ(session.status().restarts, 1u);
    EXPECT_EQ(frame->spp, 5);
    EXPECT_EQ(frame->document->scene.light_groups, d.scene.light_groups) << "for pictures that are saved";
    EXPECT_TRUE(frame->linear == headless(d)) << "as if it had been rendered so";
    EXPECT_TRUE(frame->variance == render_document(d).film.variance_image().pixels);
    EXPECT_EQ(session.display()->frame, frame);
  }
  d.scene.light_groups.clear();
  ASSERT_TRUE(shows(session, d));
  EXPECT_TRUE(session.latest()->linear == whole);
  EXPECT_EQ(session.status().restarts, 1u);
}

TEST(RenderSession, MixesWhileSamplesCome) {
  RenderSession session;
  Document d = lit_cornell(0);
  session.submit(d);
  auto wait_for = [&](auto condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience);
    while (std::chrono::steady_clock::now() < end) {
      const auto frame = session.latest();
      if (frame && condition(*frame)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  };
  int spp = 2;
  for (bool on : {false, true, false}) {
    ASSERT_TRUE(wait_for([&](const Frame& frame) { return frame.spp >= spp; }));
    light_group(d.scene, "key").on = on;
    session.submit(d);
    ASSERT_TRUE(wait_for([&](const Frame& frame) { return frame.mix[0] == vec3(on ? 1.0f : 0.0f); }));
    EXPECT_GE(session.latest()->spp, spp) << "it goes on";
    spp = session.latest()->spp + 2;
  }
  EXPECT_EQ(session.status().restarts, 1u);
}

TEST(RenderSession, MixesWhilePausedAndDenoised) {
  RenderSession session;
  Document d = lit_cornell(4);
  d.settings.display.denoise = true;
  ASSERT_TRUE(shows(session, d));
  session.pause(true);
  light_group(d.scene, "sky").on = false;
  ASSERT_TRUE(shows(session, d));
  auto picture = session.display();
  ASSERT_TRUE(picture->denoised);
  EXPECT_EQ(picture->denoised->mix, picture->frame->mix);
  EXPECT_TRUE(picture->frame->linear == headless(d));
  OfflineResult rendered = render_document(d);
  FeatureFilm features(61, 43);
  const auto expected =
      denoise_render(noisy_image(rendered.film), rendered.spp, *rendered.scene, d, features);
  EXPECT_TRUE(picture->denoised->linear == expected->pixels) << "the mix is denoised";
  EXPECT_EQ(session.status().restarts, 1u);
}

TEST(RenderSession, RestartsWhereGroupsAreScaledInTheScene) {
  RenderSession session;
  Document d = lit_cornell(3);
  d.settings.film.light_groups = LightGroupsIn::scene;
  ASSERT_TRUE(shows(session, d));
  light_group(d.scene, "key").on = false;
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 2u);
  EXPECT_TRUE(session.latest()->mix.empty());
  EXPECT_TRUE(session.latest()->linear == headless(d));
  d.settings.film.light_groups = LightGroupsIn::film; // and back
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 3u);
  EXPECT_EQ(session.latest()->mix.size(), 3u);
  EXPECT_TRUE(session.latest()->linear == headless(d));
  d.settings.view = View::variance; // of the mix
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 3u);
  EXPECT_TRUE(session.latest()->linear == view_image(render_document(d).film, View::variance).pixels);
}

} // namespace
} // namespace candela
