// Tangents and footprints of texture coordinates, against finite differences.

#include "render/camera/camera_model.h"
#include "render/camera/camera_view.h"
#include "render/render_testing.h"
#include "render/world/ray_cone.h"

namespace candela::test {
namespace {

struct At {
  vec2 uv;
  vec3 position, normal;
  SurfaceTangents tangents;
};

At at(const Geometry& g, const Ray& ray) {
  const auto hit = g.accel().intersect(ray);
  EXPECT_TRUE(hit);
  if (!hit) return {};
  const SurfaceInteraction s = g.surface(ray, *hit);
  return {g.uv(ray, *hit), s.position, s.geometric_normal, g.tangents(ray, *hit)};
}

std::shared_ptr<const Geometry> geometry_of(const Shape& shape, const mat4& m) {
  return Geometry::build({Instance{"", shape, m, {0}}});
}

mat4 placed(vec3 scale) {
  mat4 m = glm::translate(mat4(1), {0.3f, -0.2f, 0.5f});
  m = glm::rotate(m, 0.7f, glm::normalize(vec3(1, 2, -0.5f)));
  return glm::scale(m, scale);
}

Mesh mapped_triangle() {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0.2f}, {0, 1, 0}};
  mesh.uvs = {{0.1f, 0.2f}, {0.8f, 0.1f}, {0.3f, 0.9f}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(SurfaceTangents, TellHowTheCoordinatesChange) {
  const Shape shapes[] = {SphereShape{1}, DiscShape{}, std::make_shared<const Mesh>(mapped_triangle())};
  for (const Shape& shape : shapes)
    for (vec3 scale : {vec3(1.5f), vec3(1.5f, -1.5f, 1.5f), vec3(0.8f, 1.2f, 1.6f)}) {
      SCOPED_TRACE(testing::Message() << shape_name(shape) << ' ' << scale.x << ' ' << scale.y);
      const mat4 m = placed(scale);
      const auto g = geometry_of(shape, m);
      for (vec3 target : {vec3(0.2f, -0.3f, 0), vec3(-0.1f, 0.4f, 0), vec3(0.3f, 0.2f, 0)}) {
        const vec3 to = transform_point(m, target), from = transform_point(m, target + vec3(0.3f, -0.4f, 3));
        const vec3 along = glm::normalize(to - from);
        const At here = at(*g, {from, 0, along, kInfinity});
        ASSERT_TRUE(here.tangents.has_uv);
        EXPECT_NEAR(glm::dot(glm::normalize(here.tangents.dpdu), here.normal), 0, 1e-2f);
        // A step in the parameters is the step on the surface that the derivatives say, to first order.
        for (vec3 aside : {glm::normalize(here.tangents.dpdu), glm::normalize(here.tangents.dpdv)}) {
          constexpr float kStep = 2e-3f;
          const At there = at(*g, {from + kStep * aside, 0, along, kInfinity});
          const vec2 step = there.uv - here.uv;
          const vec3 predicted = here.tangents.dpdu * step.x + here.tangents.dpdv * step.y,
                     real = there.position - here.position;
          EXPECT_LT(glm::length(predicted - real), 0.03f * glm::length(real));
        }
      }
    }
}

TEST(SurfaceTangents, ArePerpendicularWhereTheCoordinatesDoNotTell) {
  Mesh bare = mapped_triangle();
  bare.uvs.clear();
  Mesh folded = mapped_triangle();
  folded.uvs[2] = 0.5f * (folded.uvs[0] + folded.uvs[1]);
  for (const Mesh& mesh : {bare, folded}) {
    const auto g = geometry_of(std::make_shared<const Mesh>(mesh), mat4(1));
    const At a = at(*g, {{0, 0, 3}, 0, {0, 0, -1}, kInfinity});
    EXPECT_FALSE(a.tangents.has_uv);
    EXPECT_NEAR(glm::dot(a.tangents.dpdu, a.tangents.dpdv), 0, 1e-6f);
    EXPECT_NEAR(glm::dot(a.tangents.dpdu, a.normal), 0, 1e-6f);
    EXPECT_NEAR(glm::length(a.tangents.dpdv), 1, 1e-6f);
    EXPECT_EQ(uv_footprint({0, 0, -1}, a.normal, 1, a.tangents).major, vec2(0));
  }
}

TEST(RayCone, FootprintOfAPlaneAtAnAngleIsItsClosedForm) {
  // A plane z = 0 with u = x / 4, v = y / 2, from the distance d at the angle theta to its normal, in the xz
  // plane: width / cos(theta) along x, width along y.
  const SurfaceTangents tangents{{4, 0, 0}, {0, 2, 0}, true};
  for (float degrees : {0.0f, 30.0f, 60.0f, 85.0f}) {
    const float theta = radians(degrees), d = 5, spread = 0.002f;
    const float width = RayCone{0.001f, spread}.width_at(d);
    EXPECT_NEAR(width, 0.011f, 1e-6f);
    const vec3 direction(std::sin(theta), 0, -std::cos(theta));
    const UvFootprint f = uv_footprint(direction, {0, 0, 1}, width, tangents);
    EXPECT_NEAR(std::abs(f.major.x), width / std::cos(theta) / 4, 1e-4f * width / std::cos(theta));
    EXPECT_NEAR(f.major.y, 0, 1e-6f);
    EXPECT_NEAR(std::abs(f.minor.y), width / 2, 1e-4f * width);
    EXPECT_NEAR(f.minor.x, 0, 1e-6f);
  }
}

TEST(RayCone, FootprintIsWhatAPixelOfTheCameraCovers) {
  SceneMaker s(64, 64, 1);
  s.camera({0, -4, 2}, {0, 0, 0}, 30);
  const CameraView view(s.document.scene.camera, 64, 64);
  const auto camera = make_camera(s.document.scene.camera, 64, 64);
  Mesh plane;
  plane.positions = {{-9, -9, 0}, {27, -9, 0}, {-9, 27, 0}};
  plane.uvs = {{0, 0}, {6, 0}, {0, 12}};
  plane.triangles = {{0, 1, 2}};
  const auto g = geometry_of(std::make_shared<const Mesh>(plane), mat4(1));
  auto through = [&](vec2 film) { return camera->ray(film, vec2(0))->ray; };
  const Ray ray = through({32, 32});
  const At here = at(*g, ray), right = at(*g, through({33, 32})), down = at(*g, through({32, 33}));
  const RayCone cone = RayCone::of_pixel(view.pixel_footprint(0).y, view.pixel_footprint(1).y);
  const float width = cone.width_at(glm::length(here.position - ray.origin));
  const UvFootprint f = uv_footprint(ray.direction, here.normal, width, here.tangents);
  // Looking along y the pixel's rows lie across, so the axes are those of the ellipse.
  EXPECT_NEAR(glm::length(f.minor), glm::length(right.uv - here.uv), 0.02f * glm::length(f.minor));
  EXPECT_NEAR(glm::length(f.major), glm::length(down.uv - here.uv), 0.03f * glm::length(f.major));
}

TEST(RayCone, GrowsAlongAPath) {
  const RayCone seen = RayCone{0, 0.01f}.after(2, 0);
  EXPECT_NEAR(seen.width_at(3), 0.05f, 1e-7f) << "a flat mirror changes nothing";
  EXPECT_NEAR(RayCone({0, 0.01f}).after(2, 0.1f).width_at(3), 0.35f, 1e-6f);
}

} // namespace
} // namespace candela::test
