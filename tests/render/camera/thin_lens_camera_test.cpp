// Camera rays, and the distribution of lens points.

#include "render/camera/thin_lens_camera.h"
#include "render/render_testing.h"
#include "render/world/render_scene.h"

#include <random>

namespace candela::test {
namespace {

Ray lens_ray(const CameraModel& camera, vec2 film, vec2 u_lens) {
  const auto ray = camera.ray(film, u_lens);
  EXPECT_TRUE(ray && ray->weight == 1);
  return ray ? ray->ray : Ray{};
}

Camera looking_down() {
  Camera camera;
  camera.position = {1, 2, 10};
  camera.target = {1, 2, 0};
  return camera;
}

/// Whether p is in the polygon (corners counter-clockwise); `slack` outside of it counts, too.
bool inside_polygon(vec2 p, int blades, float rotation, float slack) {
  for (int i = 0; i < blades; ++i) { // the sides' normals point to the middles of the sides
    const float angle =
        rotation + 2 * kPi * ((static_cast<float>(i) + 0.5f) / static_cast<float>(blades) + 0.25f);
    if (glm::dot(p, vec2(std::cos(angle), std::sin(angle))) >
        std::cos(kPi / static_cast<float>(blades)) + slack)
      return false;
  }
  return true;
}

TEST(ApertureStatistical, PolygonsAreSampledUniformlyByArea) {
  // Bins: n wedges of equal area, cut by rings whose areas are equal, and again across.
  constexpr int kRings = 6, kAcross = 6, kDraws = 2000000; // sees 1 % of a wedge's density
  const int counts[] = {3, 5, 16};
  std::uint64_t stream = 0;
  for (int blades : counts) {
    const float rotation = 0.3f * static_cast<float>(stream);
    const Aperture aperture(blades, rotation);
    std::mt19937_64 random(fresh_seed() + stream++);
    auto u = [&] { return to_unit_float(static_cast<std::uint32_t>(random() >> 32)); };
    std::vector<glm::dvec2> corners;
    for (int k = 0; k <= blades; ++k) {
      const double angle =
          static_cast<double>(rotation) + 2 * std::numbers::pi * (k / static_cast<double>(blades) + 0.25);
      corners.emplace_back(std::cos(angle), std::sin(angle));
    }
    std::vector<double> observed(static_cast<std::size_t>(blades * kRings * kAcross));
    for (int i = 0; i < kDraws; ++i) {
      const float x = u();
      const vec2 p = aperture.sample({x, u()});
      ASSERT_TRUE(inside_polygon(p, blades, rotation, 1e-6f)) << p.x << ' ' << p.y;
      // Coordinates of the wedge by its corners: p = a v0 + b v1, a + b the size of a similar polygon.
      double turn =
          (std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) - static_cast<double>(rotation)) /
              (2 * std::numbers::pi) -
          0.25;
      turn -= std::floor(turn);
      const int wedge = std::min(static_cast<int>(turn * blades), blades - 1);
      const glm::dvec2 v0 = corners[static_cast<std::size_t>(wedge)],
                       v1 = corners[static_cast<std::size_t>(wedge) + 1];
      const double det = v0.x * v1.y - v0.y * v1.x;
      const double a = (static_cast<double>(p.x) * v1.y - static_cast<double>(p.y) * v1.x) / det;
      const double b = (v0.x * static_cast<double>(p.y) - v0.y * static_cast<double>(p.x)) / det;
      const double size = a + b;
      const int ring = std::clamp(static_cast<int>(size * size * kRings), 0, kRings - 1);
      const int across = std::clamp(static_cast<int>(b / size * kAcross), 0, kAcross - 1);
      observed[static_cast<std::size_t>((wedge * kRings + ring) * kAcross + across)] += 1;
    }
    const std::vector<double> expected(observed.size(),
                                       static_cast<double>(kDraws) / static_cast<double>(observed.size()));
    EXPECT_GT(chi_square_test(observed, expected).p_value,
              sidak_threshold(static_cast<int>(std::size(counts))))
        << blades << " blades; " << seed_note();
  }
}

TEST(Aperture, IsContinuousButForTheMapsSeam) {
  // Neighbours in the square stay neighbours in the lens, so that well-spread points stay well spread.
  const Aperture aperture(5, 0.2f);
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j + 1 < kSteps; ++j) {
      const float x = (static_cast<float>(i) + 0.5f) / kSteps, y = (static_cast<float>(j) + 0.5f) / kSteps;
      EXPECT_LT(glm::length(aperture.sample({x, y}) - aperture.sample({x, y + 1.0f / kSteps})),
                6.0f / kSteps);
      EXPECT_LT(glm::length(aperture.sample({y, x}) - aperture.sample({y + 1.0f / kSteps, x})),
                6.0f / kSteps);
    }
}

TEST(Aperture, HasItsCornersWhereItSays) {
  for (int blades : {3, 6, 16})
    for (float rotation : {0.0f, 0.7f}) {
      const Aperture aperture(blades, rotation);
      EXPECT_EQ(aperture.blades(), blades);
      EXPECT_NEAR(aperture.area(), blades * std::sin(2 * kPi / static_cast<float>(blades)) / 2, 1e-5f);
      float farthest = 0;
      vec2 corner(0);
      for (int i = 0; i < 4096; ++i) { // along the square's upper edge: the boundary
        const vec2 p = aperture.sample({static_cast<float>(i) / 4096, kOneMinusEpsilon});
        if (glm::length(p) > farthest) farthest = glm::length(p), corner = p;
      }
      EXPECT_NEAR(farthest, 1, 1e-3f);
      const float turns = (std::atan2(corner.y, corner.x) - rotation) / (2 * kPi) - 0.25f;
      EXPECT_NEAR(turns * static_cast<float>(blades), std::round(turns * static_cast<float>(blades)), 0.05f);
    }
  for (int blades : {0, 1, 2}) {
    EXPECT_EQ(Aperture(blades, 1).blades(), 0);
    EXPECT_EQ(Aperture(blades, 1).sample({0.3f, 0.9f}), sample_uniform_disc({0.3f, 0.9f}));
  }
}

TEST(CameraView, PerspectivePixelsGrowWithTheDepth) {
  Camera camera = looking_down();
  camera.vertical_fov = radians(90.0f);
  const CameraView view(camera, 200, 100);
  EXPECT_NEAR(view.pixel_footprint(1).y, 0.02f, 1e-7f); // 2 tan(45 degrees) / 100
  EXPECT_NEAR(view.pixel_footprint(5).y, 0.1f, 1e-6f);
  EXPECT_EQ(view.pixel_footprint(5).x, view.pixel_footprint(5).y);
}

TEST(ThinLensCamera, PinholeSpansTheFieldOfView) {
  Camera c;
  c.position = {1, 2, 3};
  c.target = {1, 2, -7};
  c.vertical_fov = radians(60.0f);
  const ThinLensCamera rays(c, 200, 100);
  EXPECT_FALSE(rays.uses_lens_sample());
  EXPECT_NEAR(glm::length(lens_ray(rays, {100, 50}, {}).direction - vec3(0, 0, -1)), 0, 1e-6f);
  vec3 top = lens_ray(rays, {100, 0}, {}).direction, left = lens_ray(rays, {0, 50}, {}).direction;
  EXPECT_NEAR(std::atan2(top.y, -top.z), radians(30.0f), 1e-6f);
  EXPECT_LT(left.x, 0);
  EXPECT_NEAR(-left.x / -left.z, 2 * std::tan(radians(30.0f)), 1e-5f); // square pixels
}

TEST(ThinLensCamera, LensIsSharpInTheFocusPlaneAndBlursByTheCircleOfConfusion) {
  Camera c;
  c.position = {0, 0, 0};
  c.target = {0, 0, -1};
  c.aperture_radius = 0.2f;
  c.focus_distance = 4;
  const ThinLensCamera rays(c, 64, 64);
  Camera pinhole = c;
  pinhole.aperture_radius = 0;
  const ThinLensCamera sharp(pinhole, 64, 64);
  auto at_depth = [](const Ray& r, float depth) { return r.at((-depth - r.origin.z) / r.direction.z); };
  float largest = 0;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      vec2 u((static_cast<float>(i) + 0.5f) / 64, (static_cast<float>(j) + 0.5f) / 64), film(20.3f, 41.7f);
      Ray r = lens_ray(rays, film, u), s = lens_ray(sharp, film, {});
      ASSERT_LE(glm::length(r.origin), 0.2f * 1.0001f);
      ASSERT_EQ(r.origin.z, 0);
      ASSERT_LT(glm::length(at_depth(r, 4) - at_depth(s, 4)), 2e-6f);
      largest = std::max(largest, glm::length(at_depth(r, 10) - at_depth(s, 10)));
    }
  // Radius of the blur in the plane at depth z: aperture |z - f| / f.
  EXPECT_LE(largest, 0.2f * 6 / 4 * 1.0001f);
  EXPECT_GT(largest, 0.2f * 6 / 4 * 0.97f);
}

TEST(ThinLensCamera, WithoutAFocusDistanceTheTargetIsSharp) {
  Camera c;
  c.position = {0, 0, 5};
  c.target = {0, 0, 2};
  EXPECT_EQ(c.effective_focus_distance(), 3);
  c.focus_distance = 7;
  EXPECT_EQ(c.effective_focus_distance(), 7);
}

TEST(ThinLensCamera, OrthographicRaysAreParallelAndEquallySpaced) {
  Camera camera = looking_down();
  camera.projection = Projection::orthographic;
  camera.orthographic_height = 6;
  const ThinLensCamera rays(camera, 40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const Ray ray = lens_ray(rays, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, vec2(0));
      EXPECT_EQ(ray.direction, vec3(0, 0, -1));
      // 6 units over 30 pixels, square; the film's middle is the camera's position.
      const vec3 expected(1 + 0.2f * (static_cast<float>(x) + 0.5f - 20),
                          2 - 0.2f * (static_cast<float>(y) + 0.5f - 15), 10);
      EXPECT_LT(glm::length(ray.origin - expected), 1e-5f);
    }
  const CameraView view(camera, 40, 30);
  EXPECT_EQ(view.pixel_footprint(1), view.pixel_footprint(100)) << "nothing gets smaller far away";
  EXPECT_NEAR(view.pixel_footprint(7).x, 0.2f, 1e-6f);
}

TEST(ThinLensCamera, AnAspectStretchesTheViewOverTheFilm) {
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = looking_down();
    camera.projection = projection;
    camera.vertical_fov = radians(90.0f);
    camera.orthographic_height = 2;
    camera.aspect = 2.5f;
    const ThinLensCamera rays(camera, 64, 64);
    auto at_distance_one = [&](vec2 film) {
      const Ray ray = lens_ray(rays, film, vec2(0));
      const vec3 p = ray.at((9 - ray.origin.z) / ray.direction.z);
      return vec2(p) - vec2(camera.position);
    };
    EXPECT_LT(glm::length(at_distance_one({0, 0}) - vec2(-2.5f, 1)), 1e-5f);
    EXPECT_LT(glm::length(at_distance_one({64, 64}) - vec2(2.5f, -1)), 1e-5f);
    const CameraView view(camera, 64, 64);
    EXPECT_NEAR(view.pixel_footprint(1).x / view.pixel_footprint(1).y, 2.5f, 1e-5f);
  }
}

TEST(ThinLensCamera, ProjectingUndoesTheRay) {
  for (Projection projection : {Projection::perspective, Projection::orthographic})
    for (float aspect : {0.0f, 1.7f}) {
      Camera camera;
      camera.position = {3, -1, 4};
      camera.target = {0, 0.5f, -2};
      camera.projection = projection;
      camera.aspect = aspect;
      const ThinLensCamera rays(camera, 320, 200);
      const CameraView view(camera, 320, 200);
      for (vec2 film : {vec2(0.5f, 0.5f), vec2(160, 100), vec2(311, 7), vec2(20, 199)}) {
        const Ray ray = lens_ray(rays, film, vec2(0));
        const auto back = view.project(ray.at(3.7f));
        ASSERT_TRUE(back);
        EXPECT_LT(glm::length(*back - film), 2e-3f);
        const Ray sight = view.sight(film); // a pinhole's ray is where it is seen
        EXPECT_EQ(sight.origin, ray.origin);
        EXPECT_EQ(sight.direction, ray.direction);
        EXPECT_FALSE(view.project(camera.position - ray.direction));
      }
    }
}

TEST(ThinLensCamera, TheLensMeetsOnThePlaneOfFocusAndBlursByTheClosedForm) {
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = looking_down();
    camera.projection = projection;
    camera.aperture_radius = 0.5f;
    camera.focus_distance = 4;
    Camera pinhole = camera;
    pinhole.aperture_radius = 0;
    const ThinLensCamera rays(camera, 100, 80), straight(pinhole, 100, 80);
    const CameraView view(camera, 100, 80), pinhole_view(pinhole, 100, 80);
    const vec2 film(23, 61);
    const Ray middle = lens_ray(straight, film, vec2(0));
    auto at_depth = [](const Ray& ray, float depth) {
      return ray.at((10 - depth - ray.origin.z) / ray.direction.z);
    };
    for (float depth : {4.0f, 2.0f, 9.0f}) {
      float widest = 0;
      for (int i = 0; i < 256; ++i) { // the rim of the lens
        const Ray ray = lens_ray(rays, film, {static_cast<float>(i) / 256, 0});
        // What is seen at that depth through the rim would be on another place of a pinhole's film.
        const auto seen = pinhole_view.project(at_depth(ray, depth));
        ASSERT_TRUE(seen);
        widest = std::max(widest, glm::length(*seen - film));
      }
      EXPECT_NEAR(2 * widest, view.blur_diameter(depth), 2e-3f * view.blur_diameter(depth) + 2e-3f) << depth;
    }
    EXPECT_EQ(view.blur_diameter(4), 0);
    EXPECT_EQ(pinhole_view.blur_diameter(9), 0);
    EXPECT_LT(glm::length(at_depth(lens_ray(rays, film, {0.9f, 0.1f}), 4) - at_depth(middle, 4)), 1e-5f);
  }
}

TEST(CameraRender, AnOrthographicDepthIsFlatOnAPlane) {
  SceneMaker s(16, 16, 4);
  s.rectangle({0, 0, 0}, {100, 0, 0}, {0, 100, 0}, s.diffuse(vec3(0.5f)));
  s.camera({0, 0, 10}, {0, 0, 0}, 45);
  s.document.scene.camera.projection = Projection::orthographic;
  s.document.settings.view = View::depth;
  const Film film = render(s.document);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_NEAR(film.mean(x, y).x, 10, 1e-4f);
}

TEST(CameraRender, ALightOutOfFocusHasTheShapeOfTheAperture) {
  // A bead at depth 2 before a lens focused at 4: its blur is the aperture, turned upside down (f > z keeps
  // it upright on the plane of focus, (f - z) / z = 1 times as large).
  constexpr int kSize = 64, kBlades = 3;
  constexpr float kRotation = 0.2f;
  SceneMaker s(kSize, kSize, 512);
  s.sphere({0, 0, 0}, 0.03f, s.diffuse(vec3(0), vec3(1000)));
  s.camera({0, 0, 2}, {0, 0, 0}, 45);
  Camera& camera = s.document.scene.camera;
  camera.aperture_radius = 0.5f;
  camera.focus_distance = 4;
  camera.blades = kBlades;
  camera.blade_rotation = kRotation;
  s.document.settings.path.max_depth = 1;
  const CameraView view(camera, kSize, kSize);
  const float radius = 0.5f * view.blur_diameter(2); // pixels
  ASSERT_GT(radius, 9);
  ASSERT_LT(radius, 0.5f * kSize);
  const Film film = render(s.document);
  constexpr float kSlack = 2; // pixels: the bead's radius of 1.2 and half a pixel's diagonal
  double light_inside = 0, light = 0;
  int lit = 0, area = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const vec2 p =
          vec2(static_cast<float>(x) + 0.5f - 0.5f * kSize, 0.5f * kSize - static_cast<float>(y) - 0.5f) /
          radius;
      const auto value = static_cast<double>(film.mean(x, y).x);
      // A lens point o looks at the bead along the film position whose point in focus is -o (f - z) / z.
      const bool inside = inside_polygon(-p, kBlades, kRotation, kSlack / radius);
      light += value;
      if (inside) light_inside += value;
      if (inside_polygon(-p, kBlades, kRotation, -kSlack / radius)) ++area, lit += value > 0;
    }
  EXPECT_GT(light, 0);
  EXPECT_EQ(light_inside, light) << "nothing falls beside the polygon";
  EXPECT_EQ(lit, area) << "all of it is lit";
}

TEST(CameraRender, EveryCameraIsTheSameBitsWithAnyNumberOfThreads) {
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    SceneMaker s(40, 30, 2);
    s.closed_box(vec3(-1), vec3(1), s.diffuse(vec3(0.5f), vec3(0.1f, 0.2f, 0.3f)));
    s.sphere({0, 0, 0}, 0.4f, s.diffuse(vec3(0.7f)));
    s.camera({0.3f, 0.2f, 0.9f}, {0, 0, -1}, 60);
    Camera& camera = s.document.scene.camera;
    camera.projection = projection;
    camera.orthographic_height = 1.5f;
    camera.aperture_radius = 0.1f;
    camera.blades = 7;
    camera.aspect = 2;
    const Film one = render(s.document, {.threads = 1, .crop = {}});
    const Film three = render(s.document, {.threads = 3, .crop = {}});
    EXPECT_EQ(one.image().pixels, three.image().pixels);
    const auto scene = RenderScene::build(s.document);
    const vec3 both =
        replay_sample(*scene, s.document, {17, 11}, 0) + replay_sample(*scene, s.document, {17, 11}, 1);
    EXPECT_LT(glm::length(0.5f * both - one.mean(17, 11)), 1e-6f);
  }
}

} // namespace
} // namespace candela::test
