// Shapes made of triangles: closed, of the right size, with outward normals.

#include "render/closed_forms.h"
#include "render/render_testing.h"
#include "render/world/shape_mesh.h"

#include <map>

namespace {

using namespace candela;
using namespace candela::test;
using glm::dvec3;

struct ShapeCase {
  const char* name;
  Shape shape;
  double area;
  bool closed;
};

std::vector<ShapeCase> shape_cases() {
  double slant = std::sqrt(0.5 * 0.5 + 3.0 * 3.0);
  return {{"cube", CubeShape{}, 24, true},
          {"cylinder", CylinderShape{0.5f, 3, true}, 2 * kPiD * 0.5 * (3 + 0.5), true},
          {"open cylinder", CylinderShape{0.5f, 3, false}, 2 * kPiD * 0.5 * 3, false},
          {"cone", ConeShape{0.5f, 3, true}, kPiD * 0.5 * (slant + 0.5), true},
          {"open cone", ConeShape{0.5f, 3, false}, kPiD * 0.5 * slant, false},
          {"torus", TorusShape{2, 0.5f}, 4 * kPiD * kPiD * 2 * 0.5, true},
          {"plane", PlaneShape{}, 32768.0 * 32768.0, false}};
}

/// The unit normal of a shape at a point of its surface, by its equation; nothing on an edge.
std::optional<vec3> normal_of(const Shape& shape, vec3 p) {
  constexpr float kNear = 1e-3f;
  float radius = glm::length(vec2(p));
  vec3 around = radius > 0 ? vec3(vec2(p) / radius, 0) : vec3(0);
  auto ends = [&](float height, vec3 side) -> std::optional<vec3> {
    bool below = std::abs(p.z) < kNear, above = std::abs(p.z - height) < kNear;
    return below ? vec3(0, 0, -1) : (above ? vec3(0, 0, 1) : side);
  };
  if (const auto* c = std::get_if<CylinderShape>(&shape)) {
    bool edge = radius > c->radius - kNear && (p.z < kNear || p.z > c->height - kNear);
    return edge ? std::nullopt : ends(c->height, around);
  }
  if (const auto* c = std::get_if<ConeShape>(&shape)) {
    bool edge = (radius > c->radius - kNear && p.z < kNear) || p.z > 0.99f * c->height;
    vec3 side = glm::normalize(vec3(c->height * vec2(around), c->radius));
    return edge ? std::nullopt : ends(2 * c->height, side);
  }
  if (const auto* t = std::get_if<TorusShape>(&shape)) return glm::normalize(p - t->radius * around);
  if (std::holds_alternative<PlaneShape>(shape)) return vec3(0, 0, 1);
  vec3 a = glm::abs(p), n(0);
  int axis = a.x > a.y && a.x > a.z ? 0 : (a.y > a.z ? 1 : 2);
  n[axis] = p[axis] > 0 ? 1.0f : -1.0f;
  return n;
}

std::shared_ptr<const Geometry> geometry_of(std::initializer_list<Shape> shapes) {
  SceneMaker s(1, 1, 1);
  int mat = s.diffuse(vec3(1));
  for (const Shape& shape : shapes) s.document.scene.instances.push_back({"", shape, mat4(1), {mat}});
  return Geometry::build(s.document.scene.instances);
}

TEST(ShapeMesh, HasTheShapesAreaAndIsClosed) {
  for (const ShapeCase& c : shape_cases()) {
    SCOPED_TRACE(c.name);
    const TriangleSet set = geometry_of({c.shape})->world();
    double area = 0, volume = 0;
    std::map<std::array<float, 6>, int> edges; // directed, by position
    for (uvec3 t : set.triangles) {
      dvec3 a(set.positions[t.x]), b(set.positions[t.y]), d(set.positions[t.z]);
      area += 0.5 * glm::length(glm::cross(b - a, d - a));
      volume += glm::dot(a, glm::cross(b, d)) / 6;
      for (int i = 0; i < 3; ++i) {
        vec3 from = set.positions[t[i]], to = set.positions[t[(i + 1) % 3]];
        ++edges[{from.x, from.y, from.z, to.x, to.y, to.z}];
        --edges[{to.x, to.y, to.z, from.x, from.y, from.z}];
      }
    }
    EXPECT_NEAR(area, c.area, 2e-4 * c.area);
    bool closed = std::ranges::all_of(edges, [](const auto& e) { return e.second == 0; });
    EXPECT_EQ(closed, c.closed) << "every edge is met by its opposite";
    if (c.closed) { EXPECT_GT(volume, 0) << "wound outwards"; }
  }
}

TEST(ShapeMesh, VolumesAreThoseOfTheSolids) {
  auto volume = [](const Shape& shape) {
    const TriangleSet set = geometry_of({shape})->world();
    double sum = 0;
    for (uvec3 t : set.triangles)
      sum += glm::dot(dvec3(set.positions[t.x]),
                      glm::cross(dvec3(set.positions[t.y]), dvec3(set.positions[t.z]))) /
             6;
    return sum;
  };
  EXPECT_NEAR(volume(CubeShape{}), 8, 1e-5);
  EXPECT_NEAR(volume(CylinderShape{0.5f, 3, true}), kPiD * 0.25 * 3, 1e-4);
  EXPECT_NEAR(volume(ConeShape{0.5f, 3, true}), kPiD * 0.25, 1e-4);
  EXPECT_NEAR(volume(TorusShape{2, 0.5f}), 2 * kPiD * kPiD * 2 * 0.25, 1e-2);
}

TEST(ShapeMesh, NormalsAreUnitOutwardAndExactAtTheVertices) {
  for (const ShapeCase& c : shape_cases()) {
    SCOPED_TRACE(c.name);
    const TriangleSet set = geometry_of({c.shape})->world();
    ASSERT_EQ(set.normals.size(), set.positions.size());
    for (uvec3 t : set.triangles) {
      vec3 a = set.positions[t.x], b = set.positions[t.y], d = set.positions[t.z];
      vec3 flat = glm::normalize(glm::cross(b - a, d - a));
      auto middle = normal_of(c.shape, (a + b + d) / 3.0f);
      if (middle) { ASSERT_GT(glm::dot(flat, *middle), 0.999f); }
      for (int i = 0; i < 3; ++i) {
        vec3 n = set.normals[t[i]], p = set.positions[t[i]];
        ASSERT_NEAR(glm::length(n), 1, 1e-5f);
        ASSERT_GT(glm::dot(n, flat), 0.99f);
        auto exact = normal_of(c.shape, p);
        if (exact && !std::holds_alternative<CubeShape>(c.shape)) { // its vertices are all on edges
          ASSERT_LT(glm::length(n - *exact), 2e-5f) << p.x << " " << p.y << " " << p.z;
        }
      }
    }
  }
}

TEST(ShapeMesh, UvsFillTheUnitSquareAndThePlaneRepeats) {
  for (const ShapeCase& c : shape_cases()) {
    SCOPED_TRACE(c.name);
    const TriangleSet set = geometry_of({c.shape})->world();
    ASSERT_EQ(set.uvs.size(), set.positions.size());
    vec2 lo(kInfinity), hi(-kInfinity);
    for (std::size_t i = 0; i < set.uvs.size(); ++i) {
      lo = glm::min(lo, set.uvs[i]), hi = glm::max(hi, set.uvs[i]);
      if (std::holds_alternative<PlaneShape>(c.shape)) { ASSERT_EQ(set.uvs[i], vec2(set.positions[i])); }
    }
    if (std::holds_alternative<PlaneShape>(c.shape)) continue;
    EXPECT_EQ(lo, vec2(0));
    EXPECT_EQ(hi, vec2(1));
    for (uvec3 t : set.triangles) { // none is turned over by a seam
      vec2 a = set.uvs[t.x], b = set.uvs[t.y], d = set.uvs[t.z];
      ASSERT_LE(std::max({std::abs(a.x - b.x), std::abs(b.x - d.x), std::abs(d.x - a.x)}), 1.0f);
      ASSERT_GT((b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x), 0)
          << "seen from outside, v is left of u";
    }
  }
}

TEST(ShapeMesh, OneMeshServesAllOfAKind) {
  SceneMaker s(1, 1, 1);
  int mat = s.diffuse(vec3(1));
  for (int i = 0; i < 6; ++i) {
    float size = 0.5f + static_cast<float>(i);
    mat4 place = glm::translate(mat4(1), {20.0f * static_cast<float>(i), 0, 0});
    s.document.scene.instances.push_back({"", CylinderShape{size, 2 * size, true}, place, {mat}});
    s.document.scene.instances.push_back({"", ConeShape{size, 3, true}, place, {mat}});
    s.document.scene.instances.push_back({"", TorusShape{2 * size, size}, place, {mat}});
  }
  auto g = Geometry::build(s.document.scene.instances);
  EXPECT_EQ(g->objects().size(), 3u);
  EXPECT_EQ(g->placed().size(), 18u);
}

TEST(ShapeMesh, RaysMeetThemWhereTheyAre) {
  auto hit = [](const Shape& shape, vec3 origin, vec3 direction) {
    auto g = geometry_of({shape});
    Ray ray{origin, 0, direction, kInfinity};
    auto h = g->accel().intersect(ray);
    return h ? g->surface(ray, *h).position : vec3(kInfinity);
  };
  EXPECT_LT(glm::length(hit(CylinderShape{2, 3, true}, {0, 0, 9}, {0, 0, -1}) - vec3(0, 0, 3)), 1e-5f);
  EXPECT_LT(glm::length(hit(CylinderShape{2, 3, false}, {9, 0, 1}, {-1, 0, 0}) - vec3(2, 0, 1)), 1e-4f);
  EXPECT_EQ(hit(CylinderShape{2, 3, false}, {1, 0, 9}, {0, 0, -1}), vec3(kInfinity)) << "open";
  EXPECT_LT(glm::length(hit(ConeShape{2, 3, true}, {9, 0, 1.5f}, {-1, 0, 0}) - vec3(1, 0, 1.5f)), 1e-4f);
  EXPECT_LT(glm::length(hit(TorusShape{2, 0.5f}, {2, 0, 9}, {0, 0, -1}) - vec3(2, 0, 0.5f)), 1e-3f);
  EXPECT_EQ(hit(TorusShape{2, 0.5f}, {0, 0, 9}, {0, 0, -1}), vec3(kInfinity)) << "through the hole";
  EXPECT_LT(glm::length(hit(PlaneShape{}, {700, -900, 5}, {0, 0, -1}) - vec3(700, -900, 0)), 1e-3f);
}

TEST(ShapeMesh, PlanesDoNotMakeTheSceneLarge) {
  auto g = geometry_of({PlaneShape{}, CubeShape{}});
  EXPECT_EQ(g->finite_bounds().lo, vec3(-1));
  EXPECT_EQ(g->finite_bounds().hi, vec3(1));
  EXPECT_GT(g->bounds().hi.x, 10000);
}

TEST(ShapeMesh, SpecialCasesOfTheTableAreProblems) {
  EXPECT_EQ(shape_problem(TorusShape{1, 0.5f}), "");
  EXPECT_TRUE(shape_problem(TorusShape{1, 1}).starts_with("minor_radius: "));
  EXPECT_TRUE(shape_problem(ConeShape{1, 0, true}).starts_with("height: "));
  EXPECT_TRUE(shape_problem(CylinderShape{kInfinity, 1, true}).starts_with("radius: "));
}

/// A convex shape of radiance L alone in the dark: the flux through a sphere around it is pi L times its
/// area.
TEST(ShapeMeshRender, EmittersShineByTheirArea) {
  for (const ShapeCase& c : shape_cases()) {
    if (!c.closed || std::holds_alternative<TorusShape>(c.shape)) continue; // a torus shines at itself
    SCOPED_TRACE(c.name);
    SceneMaker s(1, 1, 1);
    s.document.scene.instances.push_back({"", c.shape, mat4(1), {s.diffuse(vec3(0), vec3(1))}});
    auto scene = RenderScene::build(s.document);
    RunningStatistics flux;
    constexpr double kRadius = 10;
    for (std::uint64_t i = 0; i < 200000; ++i) {
      std::uint64_t h = hash_combine(fresh_seed(), i);
      auto u = [&](int k) {
        return to_unit_float(
            static_cast<std::uint32_t>(hash_combine(h, static_cast<std::uint64_t>(k)) >> 32));
      };
      vec3 out = sample_uniform_sphere({u(0), u(1)});
      LightSamplingContext ref{static_cast<float>(kRadius) * out, -out};
      auto choice = scene->all_lights().choose(ref, u(2));
      std::optional<LightSample> light;
      if (choice) light = sample_light(scene->lights()[choice->light], ref, {u(3), u(4)});
      double e = 0;
      if (light) {
        Ray ray{ref.position, 0, light->point - ref.position, 1 - 1e-4f};
        if (!scene->geometry().accel().occluded(ray))
          e = static_cast<double>(light->radiance.x * glm::dot(light->direction, ref.normal) /
                                  (choice->pmf * light->pdf));
      }
      flux.add(e * 4 * kPiD * kRadius * kRadius);
    }
    EXPECT_GT(z_test(flux, kPiD * c.area, 1e-3 * c.area), sidak_threshold(3))
        << flux.mean() << " for " << kPiD * c.area << "; " << seed_note();
  }
}

} // namespace
