// Camera navigation about a pivot, and projections to the screen.

#include "app/tools/fly_camera.h"
#include "app/tools/orbit_camera.h"
#include "app/tools/projection.h"
#include "render/camera/thin_lens_camera.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

Camera slanted(Projection projection = Projection::perspective) {
  Camera camera;
  camera.position = {3, 2, 5};
  camera.target = {0.5f, 0.3f, -0.2f};
  camera.vertical_fov = radians(40.0f);
  camera.projection = projection;
  camera.orthographic_height = 4;
  return camera;
}

constexpr PixelRect kPicture{100, 50, 640, 360};
constexpr ivec2 kFilm(1280, 720);

vec2 seen(const Camera& camera, vec3 point) {
  const auto at = ScreenProjection(camera, kPicture, kFilm).point(point);
  EXPECT_TRUE(at);
  return at.value_or(vec2(-1));
}

void expect_near(vec2 a, vec2 b, float tolerance = 0.05f) { EXPECT_LT(glm::length(a - b), tolerance); }

TEST(ScreenProjection, IsWhereTheRenderersRaysGo) {
  for (Camera camera : {slanted(), slanted(Projection::orthographic)}) {
    {
      const ThinLensCamera rays(camera, kFilm.x, kFilm.y);
      const ScreenProjection screen(camera, kPicture, kFilm);
      for (vec2 film : {vec2(0), vec2(1279, 700), vec2(300, 100)}) {
        const vec2 at = vec2(kPicture.x, kPicture.y) + 0.5f * film;
        expect_near(seen(camera, rays.ray(film, vec2(0))->ray.at(7)), at);
        EXPECT_LT(glm::length(screen.ray(at).direction - rays.ray(film, vec2(0))->ray.direction), 1e-5f);
      }
    }
    const ScreenProjection screen(camera, kPicture, kFilm);
    for (vec2 at : {vec2(120, 60), vec2(700, 400), vec2(420, 230)})
      expect_near(seen(camera, screen.ray(at).at(3)), at);
    expect_near(seen(camera, camera.target), {420, 230});
    EXPECT_NEAR(glm::length(seen(camera, camera.target + 0.5f * screen.right()) - vec2(420, 230)),
                0.5f / screen.units_per_pixel(camera.target), 0.05f);
  }
}

TEST(ScreenProjection, CutsSegmentsThatRunBehindTheCamera) {
  const Camera camera = slanted();
  const ScreenProjection screen(camera, kPicture, kFilm);
  const vec3 behind = camera.position - 3.0f * screen.forward() + 0.1f * screen.up();
  EXPECT_FALSE(screen.point(behind));
  EXPECT_FALSE(screen.segment(behind, behind + screen.right()));
  const auto cut = screen.segment(camera.target, behind);
  ASSERT_TRUE(cut);
  expect_near(cut->first, {420, 230});
  EXPECT_LT(cut->second.y, 230) << "upwards, as the far end is";
}

TEST(OrbitCamera, KeepsThePivotInItsPlaceAndDistance) {
  const vec3 pivot(1, -0.4f, 0.7f);
  for (const Camera& camera : {slanted(), slanted(Projection::orthographic)}) {
    const Camera turned = orbited_camera(camera, pivot, 0.7f, -0.3f);
    EXPECT_EQ(camera_problem(turned), "");
    expect_near(seen(turned, pivot), seen(camera, pivot));
    EXPECT_NEAR(glm::length(turned.position - pivot), glm::length(camera.position - pivot), 1e-4f);
    EXPECT_GT(glm::length(turned.position - camera.position), 1);
    // The picture does not roll.
    EXPECT_NEAR(glm::dot(ScreenProjection(turned, kPicture, kFilm).right(), camera.up), 0, 1e-5f);
  }
}

TEST(OrbitCamera, StopsAtThePoles) {
  Camera camera = slanted();
  for (int i = 0; i < 50; ++i) camera = orbited_camera(camera, vec3(0), 0.1f, 0.3f);
  EXPECT_EQ(camera_problem(camera), "");
  EXPECT_NEAR(glm::dot(glm::normalize(camera.target - camera.position), camera.up), 1, 1e-3f);
}

TEST(OrbitCamera, PansByWhatTheHandMoves) {
  const vec3 point(1, -0.4f, 0.7f);
  for (const Camera& camera : {slanted(), slanted(Projection::orthographic)}) {
    const float unit = ScreenProjection(camera, kPicture, kFilm).units_per_pixel(point);
    const Camera moved = panned_camera(camera, {-unit * 30, unit * 20});
    expect_near(seen(moved, point), seen(camera, point) + vec2(30, 20));
  }
}

TEST(OrbitCamera, ZoomsAboutThePivot) {
  const vec3 pivot(1, -0.4f, 0.7f);
  for (const Camera& camera : {slanted(), slanted(Projection::orthographic)}) {
    const Camera close = zoomed_camera(camera, pivot, 0.5f, 1e-3f);
    expect_near(seen(close, pivot), seen(camera, pivot));
    const ScreenProjection before(camera, kPicture, kFilm), after(close, kPicture, kFilm);
    EXPECT_NEAR(after.units_per_pixel(pivot), 0.5f * before.units_per_pixel(pivot), 1e-5f);
    EXPECT_LT(glm::length(after.forward() - before.forward()), 1e-5f);
    EXPECT_EQ(zoomed_camera(camera, pivot, 1e-6f, 1e-3f), camera) << "not into the point itself";
  }
}

TEST(OrbitCamera, AxisViewsLookAlongTheirAxes) {
  struct Case {
    vec3 up;
    AxisView view;
    vec3 forward, right;
  };
  const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const Case& c :
       {Case{y, AxisView::front, -z, x}, Case{y, AxisView::back, z, -x}, Case{y, AxisView::right, -x, -z},
        Case{y, AxisView::left, x, z}, Case{y, AxisView::top, -y, x}, Case{y, AxisView::bottom, y, x},
        Case{z, AxisView::front, y, x}, Case{z, AxisView::right, -x, y}, Case{z, AxisView::top, -z, x}}) {
    Camera camera = slanted();
    camera.up = glm::normalize(c.up + vec3(0.1f, 0.05f, 0.02f));
    const vec3 pivot(0.2f, 0.1f, 0);
    const Camera now = axis_camera(camera, pivot, c.view);
    EXPECT_EQ(camera_problem(now), "");
    const ScreenProjection screen(now, kPicture, kFilm);
    EXPECT_LT(glm::length(screen.forward() - c.forward), 2e-3f);
    EXPECT_LT(glm::length(screen.right() - c.right), 2e-3f);
    EXPECT_NEAR(glm::length(now.position - pivot), glm::length(camera.position - pivot), 1e-4f);
    expect_near(seen(now, pivot), {420, 230});
  }
}

TEST(OrbitCamera, TheOtherProjectionKeepsThePivotsSize) {
  const Camera camera = slanted();
  const vec3 pivot = camera.target;
  const Camera flat = other_projection(camera, pivot);
  EXPECT_EQ(flat.projection, Projection::orthographic);
  EXPECT_NEAR(ScreenProjection(flat, kPicture, kFilm).units_per_pixel(pivot),
              ScreenProjection(camera, kPicture, kFilm).units_per_pixel(pivot), 1e-5f);
  const Camera close = zoomed_camera(flat, pivot, 0.5f, 1e-3f);
  const Camera back = other_projection(close, pivot);
  EXPECT_EQ(back.projection, Projection::perspective);
  EXPECT_NEAR(ScreenProjection(back, kPicture, kFilm).units_per_pixel(pivot),
              ScreenProjection(close, kPicture, kFilm).units_per_pixel(pivot), 1e-5f);
  EXPECT_EQ(camera_problem(back), "");
}

TEST(OrbitCamera, FramesBounds) {
  const Bounds3 box{vec3(-1, 2, -3), vec3(4, 5, 0)};
  for (const Camera& camera : {slanted(), slanted(Projection::orthographic)})
    for (float aspect : {16 / 9.0f, 0.5f}) {
      const Camera framed = framing_camera(camera, box, aspect);
      const PixelRect picture{0, 0, static_cast<int>(400 * aspect), 400};
      const ScreenProjection screen(framed, picture, {picture.width, picture.height});
      vec2 lo(1e9f), hi(-1e9f);
      for (int corner = 0; corner < 8; ++corner) {
        const auto at = screen.point({(corner & 1) ? box.hi.x : box.lo.x, (corner & 2) ? box.hi.y : box.lo.y,
                                      (corner & 4) ? box.hi.z : box.lo.z});
        ASSERT_TRUE(at);
        lo = glm::min(lo, *at), hi = glm::max(hi, *at);
      }
      EXPECT_GE(std::min(lo.x, lo.y), 0);
      EXPECT_LE(hi.x, picture.width);
      EXPECT_LE(hi.y, picture.height);
      EXPECT_GT(std::max((hi.x - lo.x) / static_cast<float>(picture.width), (hi.y - lo.y) / 400), 0.5f);
    }
  EXPECT_EQ(framing_camera(slanted(), Bounds3(), 1), slanted());
}

} // namespace
} // namespace candela
