// Pairs of pictures, one for each eye.

#include "render/camera/lens_testing.h"
#include "render/camera/pixel_rays.h"
#include "render/camera/stereo_camera.h"

namespace candela::test {
namespace {

Camera pair(Stereo layout, Projection projection = Projection::perspective) {
  Camera camera;
  camera.position = {3, -1, 2};
  camera.target = {1, 0.5f, -2};
  camera.projection = projection;
  camera.stereo = layout;
  camera.interocular_distance = 0.2f;
  camera.convergence_distance = 4;
  return camera;
}

std::shared_ptr<const CameraModel> eyes_of(const Camera& c, int width, int height) {
  Camera between = c;
  between.stereo = Stereo::none;
  const ivec2 size = StereoPanes(c.stereo, width, height).size;
  return std::make_shared<const StereoCamera>(c, width, height, make_camera(between, size.x, size.y));
}

Ray ray_of(const CameraModel& camera, vec2 film, vec2 u_lens = vec2(0.5f)) {
  const auto ray = camera.ray(film, u_lens);
  EXPECT_TRUE(ray);
  return ray ? ray->ray : Ray{};
}

/// Where the ray is at a view depth.
vec3 at_depth(const CameraView& view, const Ray& ray, float depth) {
  return ray.at((depth - glm::dot(ray.origin - view.position(), view.forward())) /
                glm::dot(ray.direction, view.forward()));
}

TEST(StereoCamera, TheLeftPictureIsOnTheLeftOrOnTop) {
  for (const Stereo layout : {Stereo::side_by_side, Stereo::top_bottom}) {
    const Camera c = pair(layout);
    const CameraView view(c, 80, 60);
    const auto camera = eyes_of(c, 80, 60);
    const bool beside = layout == Stereo::side_by_side;
    const Ray left = ray_of(*camera, beside ? vec2(20, 30) : vec2(40, 15));
    const Ray right = ray_of(*camera, beside ? vec2(60, 30) : vec2(40, 45));
    EXPECT_LT(glm::length(left.origin - (view.position() - 0.1f * view.right())), 1e-6f);
    EXPECT_LT(glm::length(right.origin - (view.position() + 0.1f * view.right())), 1e-6f);
    // The middles of both pictures are the same point of the plane of convergence.
    const vec3 middle = view.position() + 4.0f * view.forward();
    EXPECT_LT(glm::length(at_depth(view, left, 4) - middle), 1e-5f);
    EXPECT_LT(glm::length(at_depth(view, right, 4) - middle), 1e-5f);
  }
}

/// Disparity of a pinhole pair, in pixels: e f (1/C - 1/z), with f in pixels.
TEST(StereoCamera, DisparityIsThatOfParallelEyes) {
  constexpr int kWidth = 400, kHeight = 150;
  for (const float convergence : {0.0f, 1.5f, 4.0f}) {
    Camera c = pair(Stereo::side_by_side);
    c.convergence_distance = convergence;
    const CameraView view(c, kWidth, kHeight);
    const float focal = 0.5f * kHeight / std::tan(0.5f * c.vertical_fov);
    for (const float depth : {0.7f, 1.5f, 3.0f, 100.0f}) {
      const vec3 point = view.position() + depth * (view.forward() + 0.1f * view.right() - 0.2f * view.up());
      // The eyes' pinholes, by hand.
      const float expected = 0.2f * focal * ((convergence > 0 ? 1 / convergence : 0) - 1 / depth);
      const auto left = view.project(point);
      ASSERT_TRUE(left);
      const vec2 right(left->x + 200 + expected, left->y);
      for (const vec2 film : {*left, right}) {
        const Ray sight = view.sight(film);
        EXPECT_LT(glm::length(at_depth(view, sight, depth) - point), 2e-5f * depth) << convergence;
        const Ray ray = ray_of(*eyes_of(c, kWidth, kHeight), film);
        EXPECT_LT(glm::length(ray.origin - sight.origin), 1e-6f);
        EXPECT_LT(glm::length(ray.direction - sight.direction), 1e-6f);
      }
    }
  }
}

TEST(StereoCamera, APointInFocusIsSharpForBothEyesThroughEveryLens) {
  for (const Lens lens : {Lens::thin, Lens::double_gauss}) {
    Camera c = pair(Stereo::side_by_side);
    c.lens = lens;
    c.aperture_radius = 0.3f;
    c.focus_distance = 2;
    c.units_per_mm = 0.01f;
    Camera mono = c;
    mono.stereo = Stereo::none;
    const CameraView view(mono, 40, 40);
    const auto stereo = eyes_of(c, 80, 40), single = make_camera(mono, 40, 40);
    for (const vec2 u : {vec2(0.5f), vec2(0.2f, 0.6f), vec2(0.7f, 0.3f)})
      for (const bool right : {false, true}) {
        const auto expected = single->ray({15, 17}, u);
        const auto actual = stereo->ray(vec2(right ? 55 : 15, 17), u);
        ASSERT_EQ(bool(expected), bool(actual));
        if (!expected) continue;
        EXPECT_EQ(expected->weight, actual->weight);
        // Rays of one eye meet where those of the camera between do, moved by s (1 - z / C).
        const vec3 shift = (right ? 0.1f : -0.1f) * view.right();
        for (const float depth : {1.0f, 2.0f, 4.0f, 9.0f})
          EXPECT_LT(glm::length(at_depth(view, actual->ray, depth) - at_depth(view, expected->ray, depth) -
                                shift * (1 - depth / 4)),
                    2e-5f * depth);
      }
  }
}

TEST(StereoCamera, AllDirectionsAreSeenByEyesOnACircleThatLookStraight) {
  Camera c = pair(Stereo::top_bottom, Projection::spherical);
  c.convergence_distance = 0;
  const CameraView view(c, 360, 360);
  const auto camera = eyes_of(c, 360, 360);
  for (int x = 7; x < 360; x += 31)
    for (const int y : {31, 60, 90, 149}) {
      const Ray left = ray_of(*camera, vec2(x, y)), right = ray_of(*camera, vec2(x, y + 180));
      EXPECT_EQ(left.direction, right.direction);
      EXPECT_LT(glm::length(0.5f * (left.origin + right.origin) - view.position()), 1e-6f);
      const vec3 between = right.origin - left.origin;
      EXPECT_NEAR(glm::dot(between, view.up()), 0, 1e-6f);
      EXPECT_NEAR(glm::dot(between, left.direction), 0, 1e-6f);
      EXPECT_NEAR(glm::length(between), 0.2f, 1e-5f);
      // The right eye is on the right.
      EXPECT_GT(glm::dot(glm::cross(left.direction, view.up()), between), 0);
    }
  for (const int y : {0, 10, 170, 179}) { // straight up and down both see the same
    const Ray left = ray_of(*camera, vec2(33, y)), right = ray_of(*camera, vec2(33, y + 180));
    EXPECT_EQ(left.origin, right.origin);
    EXPECT_EQ(left.direction, right.direction);
  }
  c.convergence_distance = 4; // meet on the sphere about the camera
  const auto toed_in = eyes_of(c, 360, 360);
  for (const int x : {0, 100, 222}) {
    const Ray left = ray_of(*toed_in, vec2(x, 80)), right = ray_of(*toed_in, vec2(x, 260));
    const vec3 meet = view.position() + 4.0f * ray_of(*camera, vec2(x, 80)).direction;
    for (const Ray& ray : {left, right})
      EXPECT_LT(glm::length(glm::cross(ray.direction, meet - ray.origin)), 1e-5f);
  }
}

TEST(StereoCamera, FiltersDoNotMixTheEyes) {
  Document document;
  document.scene.camera = pair(Stereo::side_by_side);
  document.settings.film.width = 40;
  document.settings.film.height = 20;
  document.settings.film.filter = FilterType::gaussian;
  document.settings.film.filter_radius = 3;
  const PixelRays rays(document);
  const CameraView view(document.scene.camera, 40, 20);
  bool reached_over = false;
  for (const float u : {0.001f, 0.2f, 0.8f, 0.999f})
    for (const unsigned x : {18u, 19u, 20u, 21u}) {
      Ray ray;
      ASSERT_TRUE(rays.at({x, 10}, {u, 0.5f}, vec2(0), 0, ray));
      const float side = glm::dot(ray.origin - view.position(), view.right());
      EXPECT_NEAR(side, x < 20 ? -0.1f : 0.1f, 1e-6f);
      Ray middle;
      ASSERT_TRUE(rays.at({x < 20 ? 19u : 20u, 10}, {0.5f, 0.5f}, vec2(0), 0, middle));
      const float beyond = glm::dot(ray.direction - middle.direction, view.right());
      reached_over |= x < 20 ? beyond > 0.02f : beyond < -0.02f;
    }
  EXPECT_TRUE(reached_over) << "the filter is too narrow to show it";
}

TEST(StereoCamera, IsWhatACameraWithStereoIs) {
  for (const Projection projection :
       {Projection::perspective, Projection::orthographic, Projection::spherical}) {
    const Camera c = pair(Stereo::top_bottom, projection);
    const auto made = make_camera(c, 60, 80), expected = eyes_of(c, 60, 80);
    for (const vec2 film : {vec2(10, 20), vec2(31, 70)}) {
      EXPECT_EQ(ray_of(*made, film).origin, ray_of(*expected, film).origin);
      EXPECT_EQ(ray_of(*made, film).direction, ray_of(*expected, film).direction);
    }
  }
}

TEST(StereoCamera, BothEyesZoomAboutTheMiddlesOfTheirPictures) {
  Document moving, end;
  for (Document* d : {&moving, &end}) {
    d->scene.camera = pair(Stereo::side_by_side);
    d->settings.film.width = 40;
    d->settings.film.height = 20;
    d->scene.camera.shutter_close = 1;
  }
  moving.scene.camera.motion_fov = radians(20.0f);
  end.scene.camera.vertical_fov += radians(20.0f);
  const PixelRays a(moving), b(end);
  for (const unsigned x : {3u, 12u, 22u, 37u}) {
    Ray ray, expected;
    ASSERT_TRUE(a.at({x, 4}, vec2(0.5f), vec2(0), 1, ray) && b.at({x, 4}, vec2(0.5f), vec2(0), 1, expected));
    EXPECT_LT(glm::length(ray.origin - expected.origin), 1e-5f);
    EXPECT_LT(glm::length(ray.direction - expected.direction), 1e-5f);
  }
}

TEST(StereoCamera, ProjectsWhatItSees) {
  for (const Projection projection : {Projection::orthographic, Projection::spherical}) {
    Camera c = pair(Stereo::none, projection);
    const CameraView view(c, 80, 40);
    for (const vec2 film : {vec2(3, 7), vec2(40, 20), vec2(71.5f, 33)}) {
      const auto back = view.project(view.sight(film).at(2.5f));
      ASSERT_TRUE(back);
      EXPECT_LT(glm::length(*back - film), 1e-3f);
    }
  }
}

} // namespace
} // namespace candela::test
