// Texture coordinates are defined in object space: they follow the object's transform, including rotations,
// reflections and non-uniform scales, for analytic shapes and for those converted to triangles.

#include "render/camera/picking.h"
#include "render/render_testing.h"
#include "support/textures.h"

namespace {

using namespace candela;
using namespace candela::test;
using glm::dmat3;
using glm::dvec3;

/// Uniform numbers of this run.
class Numbers {
public:
  explicit Numbers(std::uint64_t salt) : salt_(hash_combine(fresh_seed(), salt)) {}
  float in(float lo, float hi) {
    return lo + (hi - lo) * to_unit_float(static_cast<std::uint32_t>(hash_combine(salt_, ++count_) >> 32));
  }
  vec3 direction() { return sample_uniform_sphere({in(0, 1), in(0, 1)}); }

private:
  std::uint64_t salt_, count_ = 0;
};

constexpr double kRounding = 1e-5;

enum class Kind { similarity, mirrored_similarity, scaled, mirrored, sheared };
constexpr Kind kKinds[] = {Kind::similarity, Kind::mirrored_similarity, Kind::scaled, Kind::mirrored,
                           Kind::sheared};

bool keeps_round(Kind kind) { return kind == Kind::similarity || kind == Kind::mirrored_similarity; }

mat4 transform_of(Kind kind, Numbers& u) {
  const float size = std::exp2(u.in(-4, 4)); // and so far away that positions do not lose the uvs' digits
  mat4 m = glm::translate(mat4(1), size * vec3(u.in(-2, 2), u.in(-2, 2), u.in(-2, 2)));
  m = glm::rotate(m, u.in(0, 2 * kPi), u.direction());
  switch (kind) {
  case Kind::similarity: return glm::scale(m, vec3(size));
  case Kind::mirrored_similarity: return glm::scale(m, size * vec3(1, -1, 1));
  case Kind::scaled: return glm::scale(m, size * vec3(u.in(0.3f, 0.8f), u.in(0.9f, 1.2f), u.in(1.5f, 2)));
  case Kind::mirrored: return glm::scale(m, size * vec3(u.in(0.3f, 0.8f), u.in(0.9f, 1.2f), -u.in(1.5f, 2)));
  case Kind::sheared: {
    mat4 shear(1);
    shear[1].x = u.in(0.2f, 0.8f);
    shear[2].y = u.in(-0.8f, -0.2f);
    return glm::scale(m, vec3(size)) * shear;
  }
  }
  return m;
}

struct UvHit {
  vec2 uv;
  dvec3 local; ///< where it is, in the shape's space
};

UvHit hit_at(const Geometry& g, const mat4& m, vec3 local_origin, vec3 local_target) {
  const vec3 from = transform_point(m, local_origin), to = transform_point(m, local_target);
  const Ray ray{from, 0, glm::normalize(to - from), kInfinity};
  const auto hit = g.accel().intersect(ray);
  EXPECT_TRUE(hit);
  if (!hit) return {};
  const vec3 p = g.surface(ray, *hit).position;
  return {g.uv(ray, *hit), glm::inverse(dmat3(m)) * (dvec3(p) - dvec3(vec3(m[3])))};
}

std::shared_ptr<const Geometry> geometry_of(const Shape& shape, const mat4& m) {
  return Geometry::build({Instance{"", shape, m, {0}}});
}

/// Longitude and latitude as they are defined, in double precision.
glm::dvec2 exact_sphere_uv(dvec3 d) {
  const double turn = std::atan2(d.y, d.x) / (2 * std::numbers::pi);
  return {turn < 0 ? turn + 1 : turn, 1 - std::atan2(std::hypot(d.x, d.y), d.z) / std::numbers::pi};
}

TEST(TextureCoordinates, OfSpheresAreLongitudeAndLatitudeInTheirOwnSpace) {
  SCOPED_TRACE(seed_note());
  for (Kind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    Numbers u(1 + static_cast<std::uint64_t>(kind));
    for (int i = 0; i < 20; ++i) {
      const float radius = u.in(0.5f, 3);
      const mat4 m = transform_of(kind, u);
      const auto g = geometry_of(SphereShape{radius}, m);
      ASSERT_EQ(g->spheres().size(), keeps_round(kind) ? 1u : 0u);
      for (int j = 0; j < 100; ++j) {
        const UvHit hit = hit_at(*g, m, 4.0f * radius * u.direction(), 0.9f * radius * u.direction());
        const glm::dvec2 exact = exact_sphere_uv(hit.local);
        const double around = std::abs(static_cast<double>(hit.uv.x) - exact.x); // the seam joins 0 and 1
        const double circle = glm::length(glm::dvec2(hit.local)) / static_cast<double>(radius);
        ASSERT_LT(std::min(around, 1 - around) * circle, kRounding);
        ASSERT_NEAR(static_cast<double>(hit.uv.y), exact.y, kRounding);
      }
    }
  }
}

TEST(TextureCoordinates, OfDiscsAreTheirOwnXAndY) {
  SCOPED_TRACE(seed_note());
  for (Kind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    Numbers u(11 + static_cast<std::uint64_t>(kind));
    for (int i = 0; i < 20; ++i) {
      const mat4 m = transform_of(kind, u);
      const auto g = geometry_of(DiscShape{}, m);
      ASSERT_EQ(g->discs().size(), keeps_round(kind) ? 1u : 0u);
      for (int j = 0; j < 100; ++j) {
        const float r = u.in(0, 0.99f), phi = u.in(0, 2 * kPi);
        vec3 from = 3.0f * u.direction();
        if (std::abs(from.z) < 0.5f) from.z = j % 2 == 0 ? 0.5f : -0.5f;
        const UvHit hit = hit_at(*g, m, from, {r * std::cos(phi), r * std::sin(phi), 0});
        ASSERT_NEAR(static_cast<double>(hit.uv.x), 0.5 * hit.local.x + 0.5, kRounding);
        ASSERT_NEAR(static_cast<double>(hit.uv.y), 0.5 * hit.local.y + 0.5, kRounding);
      }
    }
  }
}

TEST(TextureCoordinates, DoNotJumpWhereAShapeBecomesTriangles) {
  SCOPED_TRACE(seed_note());
  Numbers u(21);
  const Shape shapes[] = {SphereShape{1}, DiscShape{}};
  for (const Shape& shape : shapes)
    for (int i = 0; i < 40; ++i) {
      const mat4 round = transform_of(i % 2 == 0 ? Kind::similarity : Kind::mirrored_similarity, u);
      const mat4 stretched = glm::scale(round, {1.0001f, 1, 1});
      const auto a = geometry_of(shape, round), b = geometry_of(shape, stretched);
      ASSERT_EQ(a->world().triangles.size(), 0u);
      ASSERT_GT(b->world().triangles.size(), 0u);
      for (int j = 0; j < 50; ++j) {
        vec3 at = u.direction();
        vec3 from = 3.0f * at;
        if (std::holds_alternative<DiscShape>(shape)) from.z = 2, at = vec3(0.9f * vec2(at), 0);
        const vec2 p = hit_at(*a, round, from, at).uv, q = hit_at(*b, stretched, from, at).uv;
        const float around = std::abs(p.x - q.x), circle = glm::length(vec2(at));
        ASSERT_LT(std::min(around, 1 - around) * circle, 1e-4f);
        ASSERT_NEAR(p.y, q.y, 1e-4f);
      }
    }
}

/// Seen from outside, with +z up, u runs to the right and v upwards, on whatever stands on the z axis alike.
TEST(TextureCoordinates, StandUprightSeenFromOutside) {
  const Shape shapes[] = {SphereShape{1}, CylinderShape{1, 1, false}, ConeShape{1, 1, false}};
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape_name(shape));
    const auto g = geometry_of(shape, mat4(1));
    for (int k = 0; k < 8; ++k) {
      const float phi = 2 * kPi * (static_cast<float>(k) + 0.5f) / 8;
      const vec3 out(std::cos(phi), std::sin(phi), 0), right(-out.y, out.x, 0); // of who looks along -out
      auto uv = [&](vec3 p) { return hit_at(*g, mat4(1), p + 5.0f * out, p).uv; };
      const vec3 middle = 0.9f * out + vec3(0, 0, 0.1f);
      const vec2 here = uv(middle), beside = uv(middle + 0.02f * right),
                 above = uv(middle + vec3(0, 0, 0.02f));
      EXPECT_NEAR(here.x, phi / (2 * kPi), 1e-3f) << "all begin at +x";
      EXPECT_GT(beside.x - here.x, 1e-3f);
      EXPECT_NEAR(beside.y, here.y, 1e-3f);
      EXPECT_GT(above.y - here.y, 1e-3f);
      EXPECT_NEAR(above.x, here.x, 1e-3f);
    }
  }
}

TEST(TextureCoordinates, AreSharpFarFromTheOrigin) {
  for (const Shape& shape : {Shape(SphereShape{1}), Shape(DiscShape{})}) {
    const vec3 center(4e5f, -2e5f, 3e5f); // floats are 1/32 apart
    const auto g = geometry_of(shape, glm::translate(mat4(1), center));
    for (int i = 0; i <= 64; ++i) {
      const vec2 p(static_cast<float>(i) / 64 - 0.5f, 0.25f);
      const Ray ray{center + vec3(0, 0, 2), 0, glm::normalize(vec3(p, 0) - vec3(0, 0, 2)), kInfinity};
      const auto hit = g->accel().intersect(ray);
      ASSERT_TRUE(hit);
      const vec3 local = vec3(0, 0, 2) + hit->t * ray.direction;
      const vec2 uv = g->uv(ray, *hit);
      const vec2 exact = std::holds_alternative<DiscShape>(shape) ? 0.5f * vec2(local) + 0.5f
                                                                  : vec2(exact_sphere_uv(dvec3(local)));
      EXPECT_NEAR(uv.x, exact.x, 1e-5f);
      EXPECT_NEAR(uv.y, exact.y, 1e-5f);
    }
  }
}

TEST(TextureCoordinates, OfMeshesWithoutThemAreZeroWhateverElseIsThere) {
  SceneMaker s(1, 1, 1);
  const int mat = s.diffuse(vec3(1));
  auto mesh = std::make_shared<const Mesh>(sphere_mesh(40, 60, false)); // placed if it is there twice
  auto uv = [&] {
    const auto g = Geometry::build(s.document.scene.instances);
    return hit_at(*g, mat4(1), {0.3f, 0.2f, 3}, {0.1f, 0.2f, 0}).uv;
  };
  s.mesh_shared(mesh, mat);
  EXPECT_EQ(uv(), vec2(0)) << "alone";
  s.rectangle({9, 0, 0}, {1, 0, 0}, {0, 1, 0}, mat);
  EXPECT_EQ(uv(), vec2(0)) << "beside what has some";
  s.mesh_shared(mesh, mat, glm::translate(mat4(1), {-9, 0, 0}));
  EXPECT_EQ(uv(), vec2(0)) << "placed";
}

/// A sphere whose texture has four colours, turned, seen from -y.
Document quarters(const mat4& m, View view) {
  SceneMaker s(24, 24, 16);
  s.document.scene.textures.push_back(
      picture_texture(2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}));
  Material mat;
  color(mat, "diffuse") = vec3(0.8f);
  use_of(mat).texture = 0;
  s.document.scene.instances.push_back({"", SphereShape{}, m, {s.material(mat)}});
  s.constant_light(vec3(1));
  s.camera({0, -8, 0}, {0, 0, 0}, 18, {0, 0, 1});
  s.document.settings.view = view;
  return s.document;
}

double mean_difference(const Film& a, const Film& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const vec3 d = glm::abs(a.mean(x, y) - b.mean(x, y));
      sum += static_cast<double>(average(d)) / (a.width() * a.height());
    }
  return sum;
}

/// A convex body under a white sky shows its albedo, so that every integrator says which texel it looked up.
TEST(TextureCoordinatesRender, TurnWithTheirSphereInEveryIntegratorAndView) {
  const mat4 turn = glm::rotate(mat4(1), radians(60.0f), vec3(0, 1, 0));
  const mat4 as_triangles = glm::scale(turn, {1.001f, 1, 1});
  for (Integrator integrator : {Integrator::path, Integrator::direct, Integrator::whitted})
    for (View view : {View::radiance, View::albedo, View::uv}) {
      auto film = [&](const mat4& m) {
        Document d = quarters(m, view);
        d.settings.integrator = integrator;
        return render(d);
      };
      const Film turned = film(turn), triangles = film(as_triangles), upright = film(mat4(1));
      const double same = mean_difference(turned, triangles), other = mean_difference(turned, upright);
      EXPECT_LT(same, 0.1 * other) << static_cast<int>(integrator) << ' ' << static_cast<int>(view);
      EXPECT_GT(other, 0.03) << static_cast<int>(integrator) << ' ' << static_cast<int>(view);
    }
}

TEST(TextureCoordinatesRender, APickTellsWhatTheViewShows) {
  Document d = quarters(glm::rotate(mat4(1), 1.0f, glm::normalize(vec3(1, 2, 3))), View::uv);
  d.settings.film.filter_radius = 0.01f; // the pixels' centres
  const Film film = render(d);
  const auto scene = RenderScene::build(d);
  for (ivec2 at : {ivec2(12, 12), ivec2(8, 15), ivec2(16, 9)}) {
    const auto picked = pick(*scene, d, vec2(at) + 0.5f);
    ASSERT_TRUE(picked);
    EXPECT_LT(glm::length(vec2(film.mean(at.x, at.y)) - picked->uv), 2e-3f);
  }
}

} // namespace
