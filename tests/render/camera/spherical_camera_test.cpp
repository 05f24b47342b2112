// The camera that sees all directions.

#include "render/camera/lens_testing.h"
#include "render/camera/spherical_camera.h"

namespace candela::test {
namespace {

Camera tilted() {
  Camera camera;
  camera.position = {3, -1, 2};
  camera.target = {1, 0.5f, -2};
  return camera;
}

vec3 direction(const SphericalCamera& camera, vec2 film) {
  const auto ray = camera.ray(film, {});
  EXPECT_TRUE(ray && ray->weight == 1 && ray->ray.origin == vec3(3, -1, 2));
  return ray ? ray->ray.direction : vec3(0);
}

TEST(SphericalCamera, KnowsForwardRightAndUp) {
  const Camera c = tilted();
  const CameraView view(c, 80, 40);
  const SphericalCamera camera(c, 80, 40);
  EXPECT_FALSE(camera.uses_lens_sample());
  auto expect_direction = [&](vec2 film, vec3 expected) {
    EXPECT_LT(glm::length(direction(camera, film) - expected), 1e-6f) << film.x << ' ' << film.y;
  };
  expect_direction({40, 20}, view.forward());
  expect_direction({60, 20}, view.right());
  expect_direction({20, 20}, -view.right());
  expect_direction({0, 20}, -view.forward());
  expect_direction({80, 20}, -view.forward());
  expect_direction({33, 0}, view.up());
  expect_direction({7, 40}, -view.up());
  expect_direction({40, 10}, glm::normalize(view.forward() + view.up()));
  // It continues beyond the edges.
  EXPECT_LT(glm::length(direction(camera, {-5, 12}) - direction(camera, {75, 12})), 1e-5f);
  EXPECT_LT(glm::length(direction(camera, {10, -3}) - direction(camera, {50, 3})), 1e-5f);
}

TEST(SphericalCamera, SolidAnglesOfItsPixelsAddUpToTheSphere) {
  for (int height : {1, 2, 37, 512}) {
    const int width = 2 * height + 1;
    const SphericalCamera camera(tilted(), width, height);
    double sum = 0;
    for (int y = 0; y < height; ++y) sum += width * camera.pixel_solid_angle(y);
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-11);
  }
}

TEST(SphericalCamera, PicturesIntegrateByTheSolidAngles) {
  // Low orders of the sphere: mean 0 of w, 1/3 of w_i w_j where i = j.
  constexpr int kWidth = 256, kHeight = 128;
  const SphericalCamera camera(tilted(), kWidth, kHeight);
  glm::dvec3 mean(0);
  glm::dmat3 second(0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 w(direction(camera, vec2(x, y) + 0.5f));
      mean += camera.pixel_solid_angle(y) * w;
      second += camera.pixel_solid_angle(y) * glm::outerProduct(w, w);
    }
  EXPECT_LT(glm::length(mean), 1e-5);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(second[i][j], i == j ? 4 * std::numbers::pi / 3 : 0, 1e-3) << i << ' ' << j;
}

TEST(SphericalCameraStatistical, DirectionsFallIntoPixelsBySolidAngle) {
  // Every direction of the sphere is that of one film position, and pixels are as large as they say.
  constexpr int kWidth = 48, kHeight = 24, kDraws = 200000;
  const Camera c = tilted();
  const CameraView view(c, kWidth, kHeight);
  const SphericalCamera camera(c, kWidth, kHeight);
  Uniform u(30);
  std::vector<double> observed(kWidth * kHeight), expected;
  for (int i = 0; i < kDraws; ++i) {
    const float z = 2 * u() - 1, phi = 2 * kPi * u(), r = std::sqrt(1 - z * z);
    const vec3 w(r * std::cos(phi), r * std::sin(phi), z);
    const float longitude = std::atan2(glm::dot(w, view.right()), glm::dot(w, view.forward()));
    const vec2 film((0.5f + longitude / (2 * kPi)) * kWidth,
                    std::acos(std::clamp(glm::dot(w, view.up()), -1.0f, 1.0f)) * kInvPi * kHeight);
    ASSERT_LT(glm::length(direction(camera, film) - w), 2e-3f);
    const int x = std::clamp(static_cast<int>(film.x), 0, kWidth - 1),
              y = std::clamp(static_cast<int>(film.y), 0, kHeight - 1);
    observed[static_cast<std::size_t>(y * kWidth + x)] += 1;
  }
  for (int y = 0; y < kHeight; ++y)
    expected.insert(expected.end(), kWidth, kDraws * camera.pixel_solid_angle(y) / (4 * std::numbers::pi));
  EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(1)) << seed_note();
}

} // namespace
} // namespace candela::test
