// Information about the picture (probe, histogram, focus, legend), bookmarks, and views with other
// proportions.

#include "app/harness.h"
#include "io/candela/candela_json.h"
#include "session/offline_render.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

/// The screen position of a point of the film.
vec2 on_screen(const ViewerHarness& hand, vec2 film) {
  const PixelRect rect = hand.viewer.picture_rect();
  const vec2 size(hand.state().picture->width, hand.state().picture->height);
  return vec2(rect.x, rect.y) + film / size * vec2(rect.width, rect.height);
}

std::array<int, 3> pixel_at(const ViewerHarness& hand, vec2 at) {
  const auto pixels = hand.pixels();
  const auto i = 4 * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(hand.size().x) +
                      static_cast<std::size_t>(at.x));
  return {pixels[i], pixels[i + 1], pixels[i + 2]};
}

const InspectState& inspect(const ViewerHarness& hand) { return hand.state().inspect; }

TEST(ViewerProbeUi, TellsWhatIsUnderTheMouse) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.key(Key::i);
  EXPECT_TRUE(inspect(hand).probe_visible);
  const vec2 ball(35.5f, 32.5f), wall(10.5f, 24.5f);
  hand.move(on_screen(hand, ball));
  ASSERT_TRUE(inspect(hand).probe_pixel);
  EXPECT_EQ(*inspect(hand).probe_pixel, ivec2(35, 32));
  ASSERT_TRUE(inspect(hand).probe_pick);
  const auto& instances = hand.document().scene.instances;
  EXPECT_EQ(instances[static_cast<std::size_t>(inspect(hand).probe_pick->instance)].name, "ball");
  EXPECT_TRUE(hand.find("probe"));

  hand.key(Key::h); // held
  hand.move(on_screen(hand, wall));
  EXPECT_EQ(*inspect(hand).probe_pixel, ivec2(35, 32));
  hand.key(Key::h);
  hand.frame();
  EXPECT_EQ(*inspect(hand).probe_pixel, ivec2(10, 24));
  ASSERT_TRUE(inspect(hand).probe_pick);
  EXPECT_EQ(instances[static_cast<std::size_t>(inspect(hand).probe_pick->instance)].name, "left");
  EXPECT_LT(glm::length(inspect(hand).probe_pick->geometric_normal - vec3(1, 0, 0)), 1e-5f);
  hand.move(hand.reveal("display.exposure")); // a panel is no picture
  EXPECT_FALSE(inspect(hand).probe_pixel);
  EXPECT_FALSE(inspect(hand).probe_pick);
  hand.key(Key::i);
  hand.frame();
  EXPECT_FALSE(hand.find("probe"));
}

TEST(ViewerProbeUi, AHeldPixelSurvivesASmallerFilm) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.key(Key::i);
  hand.move(on_screen(hand, {60.5f, 40.5f}));
  hand.key(Key::h);
  ASSERT_TRUE(inspect(hand).probe_frozen);
  hand.unfold("group.film", "film.width");
  hand.type_into("film.width", "32");
  hand.wait_for_picture();
  EXPECT_FALSE(inspect(hand).probe_pixel && inspect(hand).probe_pixel->x >= 32);
}

TEST(ViewerHistogramUi, CountsThePictureThatIsShown) {
  ViewerHarness hand;
  hand.wait_for_picture();
  EXPECT_FALSE(inspect(hand).histogram) << "nothing is counted while the fold is closed";
  hand.unfold("panel.inspect", "inspect.probe");
  hand.wait_until("the picture is counted",
                  [&] { return inspect(hand).histogram_of == hand.state().picture; });
  hand.frame(2);
  ASSERT_TRUE(hand.find("histogram.plot"));
  const LogHistogram& histogram = *inspect(hand).histogram;
  std::size_t counted = histogram.dark + histogram.nonfinite;
  for (std::uint32_t n : histogram.counts[LogHistogram::gray]) counted += n;
  EXPECT_EQ(counted, 64u * 48u);

  // Brighter by two stops: more pixels are clipped, but the radiance is the same.
  const std::size_t clipped = histogram.clipped_white;
  const std::uint64_t restarts = hand.state().status.restarts;
  const auto before = inspect(hand).histogram;
  const vec2 middle = hand.reveal("histogram.plot");
  const auto plot = *hand.find("histogram.plot");
  const float two_stops = 2.0f / 18 * (plot.hi.x - plot.lo.x);
  hand.drag(middle, middle + vec2(two_stops, 0));
  EXPECT_NEAR(hand.document().settings.display.exposure, 2, 0.1f);
  hand.wait_for_picture();
  hand.wait_until("the picture is counted",
                  [&] { return inspect(hand).histogram_of == hand.state().picture; });
  EXPECT_GT(inspect(hand).histogram->clipped_white, clipped);
  EXPECT_EQ(inspect(hand).histogram->counts, before->counts);
  EXPECT_EQ(hand.state().status.restarts, restarts) << "exposing restarts nothing";
  hand.double_click(middle);
  EXPECT_EQ(hand.document().settings.display.exposure, 0);
}

TEST(ViewerBookmarksUi, AreAddedRenamedVisitedAndDeleted) {
  ViewerHarness hand;
  hand.unfold("panel.bookmarks", "bookmark.add");
  const Camera start = hand.document().scene.camera;
  hand.click("bookmark.add");
  ASSERT_EQ(hand.document().scene.bookmarks.size(), 1u);
  EXPECT_EQ(hand.document().scene.bookmarks[0], (Bookmark{"View 1", start}));

  hand.key_down(Key::w);
  hand.frame(5);
  hand.key_up(Key::w);
  const Camera there = hand.document().scene.camera;
  ASSERT_NE(there, start);
  hand.click("bookmark.add");
  ASSERT_EQ(hand.document().scene.bookmarks.size(), 2u);
  hand.click("bookmark.name");
  hand.control(Key::a);
  hand.type("near");
  hand.key(Key::enter);
  hand.frame();
  EXPECT_EQ(hand.document().scene.bookmarks[1], (Bookmark{"near", there}));

  hand.click("bookmarks/0");
  EXPECT_EQ(hand.document().scene.camera, start);
  hand.click("bookmark.name");
  hand.control(Key::a);
  hand.type("near");
  hand.click("bookmark.rename");
  EXPECT_EQ(hand.document().scene.bookmarks[0].name, "near 2") << "names stay apart";
  hand.frame(2); // the text field lets go of the keyboard
  hand.key(Key::digit_2);
  EXPECT_EQ(hand.document().scene.camera, there);
  hand.key(Key::digit_7);
  EXPECT_EQ(hand.document().scene.camera, there) << "there is none";
  hand.control(Key::digit_1);
  EXPECT_EQ(hand.document().scene.bookmarks[0].camera, there);

  EXPECT_NE(candela_json(hand.document(), ".").find("\"bookmarks\": ["), std::string::npos);
  hand.click("bookmark.delete");
  ASSERT_EQ(hand.document().scene.bookmarks.size(), 1u);
  EXPECT_EQ(hand.document().scene.bookmarks[0].name, "near");
  hand.click("bookmark.delete");
  EXPECT_TRUE(hand.document().scene.bookmarks.empty());
  hand.frame();
  EXPECT_FALSE(hand.find("bookmark.delete"));
  EXPECT_EQ(candela_json(hand.document(), ".").find("bookmarks"), std::string::npos);
}

TEST(ViewerFocusUi, FocusingMarksTheDistanceForAWhile) {
  ViewerHarness hand;
  hand.wait_for_picture();
  const vec2 at = on_screen(hand, {35.5f, 32.5f});
  hand.move(at);
  hand.key(Key::f);
  ASSERT_TRUE(inspect(hand).focus_mark);
  EXPECT_EQ(inspect(hand).focus_mark->view_depth, hand.document().scene.camera.focus_distance);
  hand.frame();
  ASSERT_TRUE(hand.find("focus.mark"));
  const auto mark = *hand.find("focus.mark");
  EXPECT_LT(glm::length(0.5f * (mark.lo + mark.hi) - at), 2.0f) << "it lies on the point";
  hand.frame(1, 5);
  hand.frame();
  EXPECT_FALSE(hand.find("focus.mark"));
}

TEST(ViewerFocusUi, ShowsThePlaneOfFocusOverThePicture) {
  Document document = test_document();
  document.scene.camera.aperture_radius = 0.3f;
  document.scene.camera.focus_distance = 4.6f; // the back wall
  ViewerHarness hand(document);
  hand.wait_for_picture();
  hand.frame(2, 11); // past the hint
  const vec2 back = on_screen(hand, {32.5f, 20.5f}), ball = on_screen(hand, {36.5f, 34.5f});
  const auto back_before = pixel_at(hand, back), ball_before = pixel_at(hand, ball);
  hand.key(Key::o);
  hand.wait_until("the overlay is there", [&] { return pixel_at(hand, back) != back_before; });
  EXPECT_EQ(pixel_at(hand, ball), ball_before) << "the ball is out of focus";
  const auto tinted = pixel_at(hand, back);
  EXPECT_GT(tinted[2] - tinted[0], back_before[2] - back_before[0]) << "the tint is cool";
  // Focusing on the ball updates the overlay at once, without new depths.
  hand.unfold("panel.camera", "camera.focus_distance");
  ASSERT_TRUE(hand.find("focus.show_plane"));
  hand.type_into("camera.focus_distance", "3.2");
  hand.wait_for_picture();
  hand.key(Key::o);
  hand.frame(2);
  const auto wall_plain = pixel_at(hand, back), ball_plain = pixel_at(hand, ball);
  hand.key(Key::o);
  hand.wait_until("the overlay is there", [&] { return pixel_at(hand, ball) != ball_plain; });
  EXPECT_EQ(pixel_at(hand, back), wall_plain);
}

TEST(ViewerFalseColorUi, ScalarViewsComeWithALegend) {
  Document document = test_document();
  document.settings.view = View::depth;
  ViewerHarness hand(document);
  hand.wait_for_picture();
  EXPECT_TRUE(hand.find("legend"));
  ASSERT_TRUE(hand.state().picture->transform.false_color);
  hand.choose("display.false_color", "off");
  hand.wait_for_picture();
  EXPECT_FALSE(hand.find("legend"));
  hand.choose("display.false_color", "magma");
  hand.wait_for_picture();
  EXPECT_TRUE(hand.find("legend"));
  hand.type_into("display.false_color_max", "5");
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().picture->transform.false_color->hi, 5);
}

TEST(ViewerDisplayUi, AutomaticExposureAndFalseColoursAreThoseOfFiles) {
  for (View view : {View::radiance, View::depth}) {
    Document document = test_document();
    document.settings.view = view;
    document.settings.display.auto_exposure = true;
    document.settings.display.tone_map = ToneMap::aces;
    ViewerHarness hand(document);
    hand.wait_for_picture();
    const OfflineResult file = render_document(document);
    const Image image = file.film.image();
    std::vector<std::uint8_t> rgba(4 * image.pixels.size());
    const DisplayTransform transform = display_transform(image.pixels, image.width, image.height,
                                                         document.settings.display, view, file.display_scale);
    display_rgba8(image.pixels, {image.width}, transform, rgba);
    EXPECT_EQ(hand.state().picture->rgba, rgba);
    if (view == View::radiance) { EXPECT_NE(transform.automatic_exposure, 0); }
  }
}

TEST(ViewerCameraUi, AFittedViewOfAnAspectIsLetterboxed) {
  Document document = test_document();
  document.scene.camera.aspect = 2;
  ViewerHarness hand(document, {.size = {600, 400}, .fit_film = true});
  hand.key(Key::tab);
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.picture_rect(), (PixelRect{0, 50, 600, 300}));
  EXPECT_EQ(hand.document().settings.film.width, 600);
  EXPECT_EQ(hand.document().settings.film.height, 300);
}

TEST(ViewerCameraUi, AFixedFilmIsStretchedToItsAspect) {
  Document document = test_document(); // 64 x 48
  document.scene.camera.aspect = 3;
  ViewerHarness hand(document, {.size = {600, 400}});
  hand.key(Key::tab);
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.picture_rect(), (PixelRect{0, 100, 600, 200}));
}

TEST(ViewerCameraUi, ForwardMakesAnOrthographicViewSmaller) {
  Document document = test_document();
  document.scene.camera.projection = Projection::orthographic;
  document.scene.camera.orthographic_height = 3;
  ViewerHarness hand(document);
  const Camera before = hand.document().scene.camera;
  hand.key_down(Key::w);
  hand.frame(10);
  hand.key_up(Key::w);
  const Camera after = hand.document().scene.camera;
  EXPECT_LT(after.orthographic_height, before.orthographic_height);
  EXPECT_EQ(after.position, before.position);
  const float steps = hand.state().natural_speed * (1 / 60.0f + 10 / 30.0f) / 3.6f;
  EXPECT_NEAR(after.orthographic_height, 3 * std::exp(-steps), 1e-3f);
  hand.wait_for_picture();
  hand.move(on_screen(hand, {32, 24}));
  hand.key(Key::f);
  EXPECT_NEAR(hand.document().scene.camera.focus_distance, 4.6f, 1e-3f) << "picking works there, too";
}

TEST(ViewerScreenshotsUi, ShowWhatTheProbeAndTheHistogramTell) {
  for (auto [size, scale] : {std::pair(ivec2(1280, 720), 1.0f), std::pair(ivec2(3840, 2160), 2.0f)}) {
    Document document = test_document();
    document.scene.camera.aperture_radius = 0.05f;
    document.scene.camera.focus_distance = 3.4f;
    document.scene.camera.blades = 6;
    document.settings.film.width = 480; // the panels matter here
    document.settings.film.height = 270;
    document.settings.stop.spp = 16;
    document.scene.bookmarks = {{"front", document.scene.camera}, {"plan", document.scene.camera}};
    ViewerHarness hand(document, {.size = size, .scale = scale});
    hand.wait_for_picture(300);
    hand.frame(2, 11);
    const std::string name = fmt::format("{}x{}", size.x, size.y);
    hand.unfold("panel.inspect", "inspect.probe");
    hand.wait_until("the picture is counted",
                    [&] { return inspect(hand).histogram_of == hand.state().picture; });
    hand.unfold("panel.bookmarks", "bookmark.add");
    hand.unfold("panel.camera", "camera.vertical_fov");
    hand.key(Key::i);
    hand.move(on_screen(hand, {264, 180})); // the ball
    hand.key(Key::f);
    hand.wait_for_picture(300);
    hand.wait_until("the picture is counted",
                    [&] { return inspect(hand).histogram_of == hand.state().picture; });
    hand.reveal("histogram.plot");
    hand.frame(2);
    hand.key(Key::o);
    for (int i = 0; i < 50; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      hand.frame(1, 0.001);
    }
    hand.screenshot(name + "_probe");
    hand.key(Key::o);
    hand.reveal("bookmark.name");
    hand.frame(2);
    hand.screenshot(name + "_bookmarks");
    hand.choose("view", "depth");
    hand.wait_for_picture(300);
    hand.screenshot(name + "_depth");
    EXPECT_TRUE(hand.find("legend"));
  }
}

} // namespace
} // namespace candela::test
