// Views of a session's samples, and stopping by noise and by convergence.

#include "render/film/film_view.h"
#include "session/session_testing.h"

namespace candela {
namespace {

using test::shows;
using test::small_cornell;

Document view_document(int spp) { return small_cornell(spp, 41, 33); }

TEST(RenderSession, ViewsOfTheSameSamplesDoNotRestart) {
  RenderSession session;
  Document d = view_document(5);
  OfflineResult headless = render_document(d);
  ASSERT_TRUE(shows(session, d));
  for (View view : {View::variance, View::samples, View::nonfinite, View::radiance}) {
    d.settings.view = view;
    ASSERT_TRUE(shows(session, d));
    EXPECT_EQ(session.latest()->view, view);
    EXPECT_TRUE(session.latest()->linear == view_image(headless.film, view).pixels);
  }
  EXPECT_EQ(session.status().restarts, 1u);
  d.settings.view = View::albedo;
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 2u);
}

TEST(RenderSession, FramesTellVarianceAndSamplesOfEveryPixel) {
  RenderSession session;
  Document d = view_document(6);
  ASSERT_TRUE(shows(session, d));
  OfflineResult headless = render_document(d);
  EXPECT_TRUE(session.latest()->variance == headless.film.variance_image().pixels);
  EXPECT_EQ(session.latest()->samples, std::vector<std::uint32_t>(41 * 33, 6));
}

TEST(RenderSession, StopsAtTheNoiseWhereTheHeadlessRenderDoes) {
  Document d = view_document(0);
  d.settings.stop.noise = 0.08f;
  OfflineResult headless = render_document(d);
  EXPECT_TRUE(is_noise_check(headless.spp));
  EXPECT_LE(headless.noise, 0.08);
  RenderSession session;
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.latest()->spp, headless.spp);
  EXPECT_TRUE(session.latest()->linear == headless.film.image().pixels);

  d.settings.stop.noise = 0.05f; // continues from there
  ASSERT_TRUE(shows(session, d));
  EXPECT_EQ(session.status().restarts, 1u);
  EXPECT_GT(session.latest()->spp, headless.spp);
  EXPECT_TRUE(session.latest()->linear == render_document(d).film.image().pixels);
}

TEST(RenderSession, EndsWhereAdaptiveSamplingHasNothingLeftToDo) {
  Document d = view_document(0);
  d.settings.adaptive.error = 0.5f;
  d.settings.adaptive.min_spp = 4;
  OfflineResult headless = render_document(d);
  EXPECT_TRUE(headless.converged);
  RenderSession session;
  ASSERT_TRUE(shows(session, d));
  EXPECT_TRUE(session.latest()->linear == headless.film.image().pixels);
}

TEST(OfflineRender, OtherViewsHaveTheRendersSamples) {
  Document d = view_document(3);
  OfflineOptions options;
  options.components = true;
  OfflineResult rendered = render_document(d, options);
  EXPECT_EQ(render_view(d, rendered, View::samples).image.at(5, 5), vec3(3));
  Document depth = d;
  depth.settings.view = View::depth;
  OfflineResult expected = render_document(depth);
  ViewPicture picture = render_view(d, rendered, View::depth);
  EXPECT_TRUE(picture.image.pixels == expected.film.image().pixels);
  EXPECT_EQ(picture.display_scale, expected.display_scale);
}

} // namespace
} // namespace candela
