// The camera behind a lens system: where it looks, what it blurs, what its pixels weigh.

#include "render/camera/lens_testing.h"
#include "render/camera/realistic_camera.h"
#include "render/camera/thin_lens_camera.h"

namespace candela::test {
namespace {

constexpr int kWidth = 960, kHeight = 640;
const vec2 kMiddle(kWidth / 2, kHeight / 2);

Camera standing(float focus = 3) {
  Camera camera;
  camera.position = {1, 2, 10};
  camera.target = {1, 2, 0};
  camera.focus_distance = focus;
  return camera;
}

/// Where rays are at a depth along the view axis, in front of the camera of standing().
vec2 at_depth(const Ray& ray, float depth) {
  const vec3 p = ray.at((10 - depth - ray.origin.z) / ray.direction.z);
  return vec2(p) - vec2(1, 2);
}

TEST(RealisticCameraStatistical, RaysOfAPixelMeetInThePlaneInFocus) {
  Uniform u(20);
  for (const LensPrescription& lens : kLenses)
    for (float focus : {1.5f, 4.0f, 50.0f}) {
      const RealisticCamera camera(standing(focus), kWidth, kHeight, lens, {.f_stop = 8});
      ASSERT_TRUE(camera.uses_lens_sample());
      Camera thin = standing(focus);
      thin.vertical_fov = camera.vertical_fov();
      const float pixel = CameraView(thin, kWidth, kHeight).pixel_footprint(focus).y;
      double sum = 0;
      int rays = 0;
      for (int i = 0; i < 2000; ++i) {
        const auto ray = camera.ray(kMiddle, u.point());
        if (!ray) continue;
        ++rays;
        ASSERT_NEAR(glm::length(ray->ray.direction), 1, 1e-6f);
        ASSERT_LT(glm::length(at_depth(ray->ray, focus)), pixel) << lens.name << " at " << focus;
        sum += static_cast<double>(ray->weight);
      }
      EXPECT_GT(rays, 1800);
      EXPECT_GT(sum, 0);
    }
}

TEST(RealisticCameraStatistical, BlursAsAThinLensOfItsAperture) {
  // In the middle, in the paraxial limit.
  Uniform u(21);
  for (const LensPrescription& lens : kLenses) {
    Camera thin = standing(3);
    const RealisticCamera camera(thin, kWidth, kHeight, lens, {.f_stop = 16});
    thin.vertical_fov = camera.vertical_fov();
    thin.aperture_radius = static_cast<float>(camera.lens().entrance_pupil().radius) * 0.001f;
    const CameraView view(thin, kWidth, kHeight);
    for (float depth : {0.8f, 1.5f, 9.0f, 100.0f}) {
      float widest = 0;
      for (int i = 0; i < 3000; ++i)
        if (const auto ray = camera.ray(kMiddle, {u(), u() < 0.5f ? 0.01f : 0.985f}))
          widest = std::max(widest, glm::length(at_depth(ray->ray, depth)));
      // At a depth z, a |z - f| / f; on the film that is view.blur_diameter(z). Aberrations: a few hundredths
      // of a pixel.
      const float pixel = view.pixel_footprint(depth).y;
      const float expected = thin.aperture_radius * std::abs(depth - 3) / 3;
      EXPECT_NEAR(widest, expected, 0.02f * expected + 0.03f * pixel) << lens.name << ' ' << depth;
      EXPECT_NEAR(2 * widest / pixel, view.blur_diameter(depth), 0.02f * view.blur_diameter(depth) + 0.06f);
    }
  }
}

TEST(RealisticCamera, SeesWhatAThinLensOfItsFieldOfViewSees) {
  for (const LensPrescription& lens : kLenses) {
    if (lens.key == "fisheye") continue; // by design
    for (float focus : {2.5f, 1000.0f}) {
      const RealisticCamera camera(standing(focus), kWidth, kHeight, lens, {.f_stop = 16});
      Camera thin = standing(focus);
      thin.vertical_fov = camera.vertical_fov();
      const ThinLensCamera straight(thin, kWidth, kHeight);
      for (vec2 film :
           {kMiddle, vec2(0, 0), vec2(kWidth, 0), vec2(0, kHeight), vec2(300, 100), vec2(kWidth, kHeight)}) {
        const auto ray = camera.ray(film, {0.5f, 0.5f}), expected = straight.ray(film, {});
        ASSERT_TRUE(ray && expected) << lens.name;
        const vec2 p = at_depth(ray->ray, focus), q = at_depth(expected->ray, focus);
        const float distortion = 0.06f; // barrel and cushion, of the wide angle's corners
        EXPECT_LT(glm::length(p - q), distortion * glm::length(q) + 2e-4f * focus)
            << lens.name << ' ' << film.x << ' ' << film.y;
        const vec3 seen_from = ray->ray.at(-0.2f); // lies before the entrance pupil, which is at the position
        EXPECT_LT(glm::length(vec2(seen_from) - vec2(1, 2)), 0.35f);
      }
    }
  }
}

TEST(RealisticCamera, ItsFieldOfViewIsThatOfTheFocalLength) {
  for (const LensPrescription& lens : kLenses) {
    const float half = 0.5f * 35 / std::sqrt(1 + sqr(1.5f)); // mm, the film's height
    const RealisticCamera far(standing(1e6f), kWidth, kHeight, lens, {.f_stop = 32});
    EXPECT_NEAR(std::tan(0.5f * far.vertical_fov()), half / lens.focal_length,
                1e-3f * half / lens.focal_length);
    // It does not depend on the f-stop but for what that does to the focus.
    for (float focus : {3.0f, 80.0f, 1e6f}) {
      const RealisticCamera open(standing(focus), kWidth, kHeight, lens),
          stopped(standing(focus), kWidth, kHeight, lens, {.f_stop = 32});
      EXPECT_NEAR(open.vertical_fov(), stopped.vertical_fov(), 0.01f * stopped.vertical_fov()) << lens.name;
      // Near the axis, where nothing is distorted, it is what rays say.
      Camera thin = standing(focus);
      thin.vertical_fov = stopped.vertical_fov();
      const vec2 film = kMiddle + vec2(12, -9);
      const auto ray = stopped.ray(film, {0.5f, 0.5f}),
                 expected = ThinLensCamera(thin, kWidth, kHeight).ray(film, {});
      ASSERT_TRUE(ray && expected);
      const vec2 p = at_depth(ray->ray, focus), q = at_depth(expected->ray, focus);
      EXPECT_LT(glm::length(p - q), 2e-3f * glm::length(q)) << lens.name << " at " << focus;
    }
  }
}

TEST(RealisticCamera, FieldsOfViewAreThePublishedOnes) {
  // Smith's half fields, over the diagonal: 22 degrees of the double Gauss at 40.4 mm, 38 of the wide angle
  // at 34.4 mm, 77.95 of the fisheye: what the rim of its first lens leaves of them at 42.8 mm.
  const struct {
    std::string_view key;
    float diagonal, half_field, tolerance;
  } cases[] = {
      {"double_gauss", 40.4f, 22, 0.6f}, {"wide_angle", 34.4f, 38, 1}, {"fisheye", 42.8f, 77.95f, 1.5f}};
  for (const auto& c : cases) {
    const RealisticCamera camera(standing(1e6f), kWidth, kHeight, *find_lens(c.key),
                                 {.sensor_diagonal = c.diagonal});
    std::optional<CameraRay> ray; // a sliver is left of the pupil
    for (int i = 0; i < 4096 && !ray; ++i) ray = camera.ray({0, 0}, (vec2(i % 64, i / 64) + 0.5f) / 64.0f);
    ASSERT_TRUE(ray) << c.key;
    EXPECT_NEAR(degrees(std::acos(-ray->ray.direction.z)), c.half_field, c.tolerance) << c.key;
  }
}

TEST(RealisticCamera, TheUnitOfTheSceneScalesTheLensAlone) {
  for (float units : {1.0f, 0.1f, 0.001f}) {
    Camera c = standing(4000 * units);
    c.position = vec3(0);
    c.target = {0, 0, -1};
    const RealisticCamera camera(c, kWidth, kHeight, *find_lens("double_gauss"),
                                 {.f_stop = 4, .units_per_mm = units});
    EXPECT_FLOAT_EQ(camera.lens().focus_distance(), 4000);
    EXPECT_NEAR(glm::length(camera.pixel_on_film() * vec2(kWidth, kHeight)), 35, 1e-4f);
    const auto ray = camera.ray({200, 100}, {0.3f, 0.8f});
    ASSERT_TRUE(ray);
    // The front of the lens lies before the entrance pupil.
    const double sticks_out =
        static_cast<double>(camera.lens().front_vertex()) - camera.lens().entrance_pupil().z;
    EXPECT_NEAR(static_cast<double>(-ray->ray.origin.z / units), sticks_out, 3);
    const RealisticCamera metres(standing(4), kWidth, kHeight, *find_lens("double_gauss"), {.f_stop = 4});
    EXPECT_LT(glm::length(metres.ray({200, 100}, {0.3f, 0.8f})->ray.direction - ray->ray.direction), 1e-5f);
  }
}

TEST(RealisticCamera, AnAspectStretchesTheFilm) {
  Camera c = standing();
  c.aspect = 2;
  const RealisticCamera camera(c, 100, 100, *find_lens("double_gauss"));
  EXPECT_FLOAT_EQ(camera.pixel_on_film().x, 2 * camera.pixel_on_film().y);
  EXPECT_NEAR(glm::length(100.0f * camera.pixel_on_film()), 35, 1e-4f);
}

TEST(RealisticCameraStatistical, PixelsAreAsBrightAsTheLensSays) {
  // A scene of radiance 1: the mean weight, over all lens samples.
  Uniform u(22);
  int tests = 0;
  std::vector<double> p_values;
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 8.0f}) {
      const RealisticCamera camera(standing(1e7f), kWidth, kHeight, lens, {.f_stop = f_stop});
      for (vec2 film : {kMiddle, vec2(100, 100), vec2(kWidth - 1, 0), vec2(-8, kHeight + 8)}) {
        RunningStatistics brightness;
        for (int i = 0; i < 40000; ++i) {
          const auto ray = camera.ray(film, u.point());
          brightness.add(ray ? static_cast<double>(ray->weight) : 0);
        }
        const double exact =
            film == kMiddle
                ? 1
                : camera.lens().relative_illumination(glm::length((film - kMiddle) * camera.pixel_on_film()));
        EXPECT_NEAR(brightness.mean(), exact, 8e-3) << lens.name;
        EXPECT_GT(brightness.mean(), 0.1) << lens.name;
        ++tests;
        p_values.push_back(z_test(brightness, exact, 2e-3 * exact));
      }
    }
  for (double p : p_values) EXPECT_GT(p, sidak_threshold(tests)) << seed_note();
}

TEST(RealisticCameraStatistical, ExtremeSettingsGiveFiniteRaysOrNone) {
  Uniform u(23);
  for (const LensPrescription& lens : kLenses)
    for (float diagonal : {1.0f, 500.0f})
      for (float f_stop : {0.0f, 128.0f})
        for (float focal_length : {2.0f, 2000.0f})
          for (float focus : {1e-3f, 1e9f}) {
            Camera c = standing(focus);
            c.blades = f_stop > 0 ? 3 : 0;
            const RealisticCamera camera(
                c, 90, 60, lens,
                {.focal_length = focal_length, .f_stop = f_stop, .sensor_diagonal = diagonal});
            EXPECT_GT(camera.vertical_fov(), 0);
            EXPECT_LT(camera.vertical_fov(), kPi);
            int rays = 0;
            for (int i = 0; i < 200; ++i) {
              const auto ray = camera.ray(vec2(u(-8, 98), u(-8, 68)), u.point());
              if (!ray) continue;
              ++rays;
              ASSERT_TRUE(is_finite(ray->ray.origin) && is_finite(ray->ray.direction));
              ASSERT_NEAR(glm::length(ray->ray.direction), 1, 1e-5f);
              ASSERT_TRUE(std::isfinite(ray->weight) && ray->weight >= 0);
            }
            if (diagonal == 1) {
              EXPECT_GT(rays, 10) << lens.name << ' ' << f_stop << ' ' << focal_length << ' ' << focus;
            }
            EXPECT_TRUE(camera.ray({45, 30}, {0.5f, 0.5f})) << lens.name;
          }
}

} // namespace
} // namespace candela::test
