// Light that grazes coarse smooth meshes.

#include "render/integrators/smooth_terminator.h"
#include "render/render_testing.h"
#include "render/world/smooth_triangle.h"

namespace {

using namespace candela;
using namespace candela::test;

TEST(SmoothTerminator, TheOffsetLeadsToTheSphereOfTheNormals) {
  // Within a triangle of a sphere of radius 3; the sagitta is some 0.17.
  const vec3 corners[3] = {glm::normalize(vec3(1, 0.1f, 0.2f)), glm::normalize(vec3(1, 0.7f, 0.1f)),
                           glm::normalize(vec3(1, 0.3f, 0.8f))};
  SmoothTriangle t{};
  for (std::size_t i = 0; i < 3; ++i) t.positions[i] = 3.0f * corners[i], t.normals[i] = corners[i];
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; i + j <= 8; ++j) {
      const float u = static_cast<float>(i) / 8, v = static_cast<float>(j) / 8;
      const vec3 p = (1 - u - v) * t.positions[0] + u * t.positions[1] + v * t.positions[2];
      const float depth = 3 - glm::length(p),
                  left = 3 - glm::length(p + offset_to_smooth_surface(t, u, v, p));
      EXPECT_LE(std::abs(left), 0.12f * depth + 1e-6f) << u << ' ' << v << ": " << depth << " below";
    }
}

TEST(SmoothTerminator, ParallelNormalsAreNoCurve) {
  const vec3 n = glm::normalize(vec3(0.7f, 0.3f, 0.5f));
  const SmoothTriangle t{{vec3(0, 0, 0), vec3(2, 0, 0), vec3(0, 3, 0)}, {n, n, n}, n};
  EXPECT_LT(glm::length(offset_to_smooth_surface(t, 0.2f, 0.3f, {0.4f, 0.9f, 0})), 1e-6f);
}

TEST(SmoothTerminator, PathsLeaveFromTheSphere) {
  SceneMaker s(8, 8, 1);
  s.mesh(sphere_mesh(8, 16, true), s.diffuse(vec3(0.5f)));
  const auto scene = RenderScene::build(s.document);
  const Bsdf bsdf = Diffuse{vec3(0.5f)};
  int moved = 0;
  for (int i = 0; i < 400; ++i) {
    const vec3 from = 3.0f * glm::normalize(vec3(std::sin(1.7f * static_cast<float>(i)),
                                                 std::cos(2.9f * static_cast<float>(i)), 0.4f));
    const vec3 to =
        0.7f * vec3(std::cos(0.9f * static_cast<float>(i)), 0.5f * std::sin(4.1f * static_cast<float>(i)), 0);
    const Ray ray{from, 0, glm::normalize(to - from), kInfinity};
    const auto hit = scene->geometry().accel().intersect(ray);
    if (!hit) continue;
    Vertex v(*scene, ray, *hit);
    const float depth = 1 - glm::length(v.surface.position);
    smooth_terminator(v, bsdf, scene->geometry(), ray, *hit);
    // Of the sphere's normals, so it leads to the sphere (TheOffsetLeadsToTheSphereOfTheNormals).
    const float left = 1 - glm::length(v.surface.position);
    EXPECT_LE(std::abs(left), 0.15f * depth + 1e-5f) << depth << " below";
    EXPECT_EQ(v.light_context.position, v.surface.position);
    moved += left != depth;
  }
  EXPECT_GT(moved, 100);
}

/// A unit ball in the light of a lamp to the left, or in a directional light.
Document lit_ball(int lamp_size) {
  SceneMaker s(48, 48, 64);
  if (lamp_size > 0) {
    s.sphere({-6, 2, 1}, static_cast<float>(lamp_size), s.diffuse(vec3(0), vec3(10)));
  } else {
    LightDesc sun;
    sun.model = DirectionalLightModel{{-1, -0.3f, -0.25f}};
    sun.color = vec3(kPi);
    s.document.scene.lights.push_back(sun);
  }
  s.camera({0, 0, 4}, {0, 0, 0}, 45);
  s.document.scene.camera.projection = Projection::orthographic;
  s.document.scene.camera.orthographic_height = 2;
  s.document.settings.path.max_depth = 2;
  s.document.settings.sampler.seed = sampler_seed();
  return s.document;
}
Document with_ball(Document d, const Shape& ball, const Material& material) {
  d.scene.materials.push_back(material);
  d.scene.instances.push_back({"", ball, mat4(1), {static_cast<int>(d.scene.materials.size()) - 1}});
  return d;
}
Document softened(Document d, bool on) {
  d.settings.path.smooth_terminator = on;
  return d;
}
Shape coarse_ball(unsigned rings, bool smooth = true) {
  return std::make_shared<const Mesh>(sphere_mesh(rings, 2 * rings, smooth));
}
Material matte() {
  Material m;
  m.model = DiffuseMaterial{vec3(1)};
  return m;
}

/// Root of the mean square, over the pixels well within the ball's outline.
double difference(const Film& a, const Film& b) {
  double sum = 0;
  int n = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const vec2 p = (vec2(x, y) + 0.5f) / vec2(a.width(), a.height()) * 2.0f - 1.0f;
      if (glm::length(p) > 0.8f) continue;
      const double d = static_cast<double>(a.mean(x, y).g - b.mean(x, y).g);
      sum += d * d, ++n;
    }
  return std::sqrt(sum / n);
}
bool same_bits(const Film& a, const Film& b) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      if (a.mean(x, y) != b.mean(x, y)) return false;
  return true;
}

TEST(SmoothTerminatorRender, CoarseBallsComeNearTheExactOne) {
  const Document d = lit_ball(0);
  const Film exact = render(with_ball(d, SphereShape{1}, matte()));
  for (unsigned rings : {6u, 10u}) {
    const Document coarse = with_ball(d, coarse_ball(rings), matte());
    const double with = difference(render(softened(coarse, true)), exact),
                 without = difference(render(softened(coarse, false)), exact);
    // What is left is the difference between interpolated normals and the ball's, over all of it.
    EXPECT_LT(with, 0.75 * without) << rings << " rings: " << with << " of " << without;
  }
}

TEST(SmoothTerminatorRender, WhittedHasItToo) {
  Document d = lit_ball(0);
  d.settings.integrator = Integrator::whitted;
  const Film exact = render(with_ball(d, SphereShape{1}, matte()));
  const Document coarse = with_ball(d, coarse_ball(6), matte());
  EXPECT_LT(difference(render(softened(coarse, true)), exact),
            0.75 * difference(render(softened(coarse, false)), exact));
}

TEST(SmoothTerminatorRender, FineMeshesHardlyChange) {
  const Document d = lit_ball(0);
  auto change = [&](unsigned rings) {
    const Document ball = with_ball(d, coarse_ball(rings), matte());
    return difference(render(softened(ball, true)), render(softened(ball, false)));
  };
  const double coarse = change(8), fine = change(64);
  // Where it changes anything, 8 times less; and that is an eighth of the ball.
  EXPECT_LT(fine, coarse / 8) << coarse << " and " << fine;
}

TEST(SmoothTerminatorRender, KeepsTheBitsOfEverythingElse) {
  Material glass;
  glass.model = DielectricMaterial();
  auto expect_same_bits = [](const Document& d, const char* what) {
    EXPECT_TRUE(same_bits(render(softened(d, true)), render(softened(d, false)))) << what;
  };
  const Document d = lit_ball(1);
  expect_same_bits(with_ball(d, SphereShape{1}, matte()), "exact");
  expect_same_bits(with_ball(d, coarse_ball(6, false), matte()), "flat");
  Document sky = d;
  LightDesc everywhere;
  everywhere.model = ConstantLightModel{};
  sky.scene.lights.push_back(everywhere);
  sky.settings.path.max_depth = 6;
  expect_same_bits(with_ball(sky, coarse_ball(6), glass), "transmitting");
  Document inside = with_ball(d, coarse_ball(6), matte());
  inside.scene.camera.position = vec3(0);
  inside.scene.camera.target = vec3(0, 0, -1);
  inside.scene.camera.projection = Projection::perspective;
  inside.scene.camera.vertical_fov = radians(90.0f);
  inside.scene.materials[0].emission = vec3(0);
  Material glow = matte();
  glow.emission = vec3(1);
  inside = with_ball(inside, SphereShape{0.1f}, glow);
  inside.scene.instances.back().world_from_object = glm::translate(mat4(1), {0.4f, 0.2f, -0.4f});
  const Film lit = render(inside);
  EXPECT_GT(lit.mean(40, 24).g, 0) << "there is something to see";
  expect_same_bits(inside, "concave");
  EXPECT_FALSE(same_bits(render(softened(with_ball(d, coarse_ball(6), matte()), true)),
                         render(softened(with_ball(d, coarse_ball(6), matte()), false))));
}

TEST(SmoothTerminatorRender, ClosedMeshesLeakNoLight) {
  // A coarse ball within a coarse shell, of which the gap is wider than the ball's curve is high.
  SceneMaker s(24, 24, 16);
  const int white = s.diffuse(vec3(0.5f));
  const auto mesh = std::make_shared<const Mesh>(sphere_mesh(6, 10, true));
  s.mesh_shared(mesh, white);
  s.mesh_shared(mesh, white, glm::scale(mat4(1), vec3(0.75f)));
  s.mesh(sphere_mesh(7, 9, true), white, glm::scale(mat4(1), vec3(0.2f, 0.02f, 0.2f)));
  s.constant_light(vec3(1));
  s.document.settings.sampler.seed = sampler_seed();
  for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis})
    for (vec3 from : {vec3(0.8f, 0.1f, 0), vec3(0.1f, 0.5f, 0.1f)}) {
      s.camera(from, {0, 0, 0}, 100);
      s.document.settings.path.light_sampling = how;
      const Film film = render(s.document);
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) EXPECT_EQ(film.mean(x, y), vec3(0)) << x << ' ' << y;
    }
}

TEST(SmoothTerminatorRender, NothingIsLostInTheWhiteFurnace) {
  for (const char* type : {"mirror", "diffuse"}) {
    SceneMaker s(24, 24, 256);
    s.mesh(sphere_mesh(6, 10, true), s.material(lossless(type)));
    s.constant_light(vec3(1));
    s.camera({0, 0, 4}, {0, 0, 0}, 45);
    s.document.scene.camera.projection = Projection::orthographic;
    s.document.scene.camera.orthographic_height = 2;
    s.document.settings.sampler.seed = sampler_seed();
    const Film film = render(s.document);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x)
        EXPECT_NEAR(film.mean(x, y).g, 1, type == std::string("mirror") ? 1e-4 : 0.04)
            << type << ' ' << x << ' ' << y;
  }
}

} // namespace
