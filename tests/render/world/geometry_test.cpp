// Surfaces at hits, their footprints, and texture lookups.

#include "render/film/film_view.h"
#include "render/render_testing.h"
#include "sampling/filter.h"

namespace {

using namespace candela;
using namespace candela::test;

SurfaceInteraction hit_from(const Geometry& g, vec3 origin, vec3 direction) {
  Ray ray{origin, 0, glm::normalize(direction), kInfinity};
  auto hit = g.accel().intersect(ray);
  EXPECT_TRUE(hit);
  return hit ? g.surface(ray, *hit) : SurfaceInteraction{};
}

vec2 uv_from(const Geometry& g, vec3 origin, vec3 direction) {
  Ray ray{origin, 0, glm::normalize(direction), kInfinity};
  auto hit = g.accel().intersect(ray);
  EXPECT_TRUE(hit);
  return hit ? g.uv(ray, *hit) : vec2(kInfinity);
}

TEST(Geometry, FlatSurfacesHaveUnitNormalsUnderAnyTransform) {
  auto large = std::make_shared<const Mesh>(sphere_mesh(40, 60, false));
  auto smooth = std::make_shared<const Mesh>(sphere_mesh(40, 60, true));
  for (const auto& mesh : {large, smooth})
    for (int copies : {1, 2}) { // baked and placed
      SceneMaker s(1, 1, 1);
      int mat = s.diffuse(vec3(1));
      for (int i = 0; i < copies; ++i) {
        mat4 m = glm::translate(mat4(1), {10.0f * static_cast<float>(i), 0, 0});
        s.mesh_shared(mesh, mat, glm::scale(m, {-0.5f, 2, 3}));
      }
      auto g = Geometry::build(s.document.scene.instances);
      EXPECT_EQ(g->placed().size(), copies == 1 ? 0u : 2u);
      for (vec3 d : {vec3(1, 0.2f, 0.1f), vec3(0.3f, 1, 0.2f), vec3(0.1f, 0.2f, -1)}) {
        SurfaceInteraction p = hit_from(*g, 5.0f * d, -d);
        EXPECT_NEAR(glm::length(p.geometric_normal), 1, 1e-5f);
        EXPECT_NEAR(glm::length(p.shading_normal), 1, 1e-5f);
        EXPECT_GT(glm::dot(p.geometric_normal, p.position), 0) << "outside stays outside though mirrored";
        EXPECT_GT(glm::dot(p.shading_normal, p.geometric_normal), 0.9f);
        // On the ellipsoid's true normal, the gradient of (x/a)^2 + (y/b)^2 + (z/c)^2, but for the facets.
        vec3 gradient = glm::normalize(p.position / vec3(0.25f, 4, 9));
        EXPECT_GT(glm::dot(p.shading_normal, gradient), mesh == smooth ? 0.999f : 0.98f);
      }
    }
}

TEST(Geometry, ShapesLieWhereTheirTransformSays) {
  SceneMaker s(1, 1, 1);
  int a = s.diffuse(vec3(1)), b = s.diffuse(vec3(1)), c = s.diffuse(vec3(1));
  s.sphere({0, 0, 0}, 2, a);
  s.disc({10, 0, 0}, 3, {1, 0, 0}, {0, 1, 0}, b);
  s.rectangle({20, 0, 0}, {2, 0, 0}, {0, 1, 0}, c);
  auto g = Geometry::build(s.document.scene.instances);
  SurfaceInteraction p = hit_from(*g, {0, 0, 9}, {0, 0, -1});
  EXPECT_NEAR(p.position.z, 2, 1e-6f);
  EXPECT_EQ(p.geometric_normal, vec3(0, 0, 1));
  EXPECT_EQ(p.material, 0u);
  p = hit_from(*g, {0, 0, 0}, {1, 0, 0}); // from inside the normal is the outer one still
  EXPECT_EQ(p.geometric_normal, vec3(1, 0, 0));
  p = hit_from(*g, {12.9f, 0, 5}, {0, 0, -1});
  EXPECT_EQ(p.material, 1u);
  EXPECT_EQ(p.position.z, 0);
  EXPECT_NEAR(uv_from(*g, {12.9f, 0, 5}, {0, 0, -1}).x, 0.5f + 0.5f * 2.9f / 3, 1e-5f);
  p = hit_from(*g, {21, 0.5f, 5}, {0, 0, -1});
  EXPECT_EQ(p.material, 2u);
  EXPECT_EQ(p.geometric_normal, vec3(0, 0, 1));
  const vec2 uv = uv_from(*g, {21, 0.5f, 5}, {0, 0, -1});
  EXPECT_NEAR(uv.x, 0.75f, 1e-6f);
  EXPECT_NEAR(uv.y, 0.75f, 1e-6f);
}

TEST(Geometry, AFastBuildTakesOverWhatIsKnownAndMeetsTheSame) {
  SceneMaker s(1, 1, 1);
  const int mat = s.diffuse(vec3(1));
  auto large = std::make_shared<const Mesh>(sphere_mesh(120, 200, true)); // 47,600 triangles
  auto small = std::make_shared<const Mesh>(sphere_mesh(6, 10, true));
  s.mesh_shared(large, mat, glm::rotate(mat4(1), 0.3f, vec3(0, 1, 0)));
  s.mesh_shared(small, mat, glm::translate(mat4(1), {5, 0, 0}));
  std::vector<Instance>& instances = s.document.scene.instances;
  const auto first = Geometry::build(instances, BuildQuality::fast);
  instances[0].world_from_object = glm::translate(instances[0].world_from_object, {0, 0.25f, 0});
  const auto moved = Geometry::build(instances, BuildQuality::fast, nullptr, first->objects());
  const auto baked = Geometry::build(instances, BuildQuality::high, nullptr, first->objects());
  EXPECT_EQ(moved->quality(), BuildQuality::fast);
  EXPECT_EQ(baked->quality(), BuildQuality::high);
  EXPECT_TRUE(baked->objects().empty()) << "an object is only for a hand that moves it";
  ASSERT_EQ(moved->objects().size(), 1u) << "the small one is baked";
  EXPECT_EQ(moved->objects(), first->objects());
  for (int i = 0; i < 200; ++i) {
    const float phi = 0.1f * static_cast<float>(i);
    const vec3 to(i % 2 == 0 ? 0.0f : 5.0f, 0.25f, 0),
        from = to + vec3(8 * std::sin(phi), 3, 8 * std::cos(phi));
    const SurfaceInteraction a = hit_from(*moved, from, to - from), b = hit_from(*baked, from, to - from);
    EXPECT_LT(glm::length(a.position - b.position), 1e-4f) << i;
    EXPECT_GT(glm::dot(a.shading_normal, b.shading_normal), 0.9999f) << i;
  }
  instances.erase(instances.begin());
  EXPECT_EQ(Geometry::build(instances, BuildQuality::fast)->quality(), BuildQuality::high)
      << "where it saves nothing it is the same";
}

TEST(Geometry, EllipsoidsAndEllipsesAreTessellated) {
  SceneMaker s(1, 1, 1);
  int mat = s.diffuse(vec3(1));
  s.sphere({0, 0, 0}, 1, mat);
  s.document.scene.instances[0].world_from_object = glm::scale(mat4(1), {2, 1, 1});
  s.disc({10, 0, 0}, 1, {1, 0, 0}, {0, 1, 0}, mat);
  s.document.scene.instances[1].world_from_object[0] *= 2;
  auto g = Geometry::build(s.document.scene.instances);
  EXPECT_TRUE(g->spheres().empty());
  EXPECT_TRUE(g->discs().empty());
  EXPECT_NEAR(hit_from(*g, {5, 0.01f, 0.01f}, {-1, 0, 0}).position.x, 2, 0.01f);
  EXPECT_NEAR(hit_from(*g, {11.8f, 0.1f, 5}, {0, 0, -1}).geometric_normal.z, 1, 1e-5f);
}

TEST(Geometry, ARayLeavingAWallDoesNotMeetItAgain) {
  // Also in coordinate planes, where the point has no rounding error along the normal but the test of the ray
  // has.
  SCOPED_TRACE(seed_note());
  for (vec3 offset : {vec3(0), vec3(0, 3, 0), vec3(100, 50, -70)}) {
    SceneMaker s(1, 1, 1);
    s.rectangle(offset, {0, 0, 20}, {20, 0, 0}, s.diffuse(vec3(1)));
    auto g = Geometry::build(s.document.scene.instances);
    int again = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      auto u = [&](std::uint64_t k) {
        return to_unit_float(static_cast<std::uint32_t>(hash_combine(fresh_seed() + k, i)));
      };
      vec3 p = offset + vec3(38 * u(1) - 19, 0, 38 * u(2) - 19);
      SurfaceInteraction surface = hit_from(*g, p + vec3(u(3), 2, u(4)), vec3(-u(3), -2, -u(4)));
      vec3 w = sample_uniform_hemisphere({u(5), u(6)});
      w = {w.x, w.z, w.y};
      if (!(w.y > 1e-4f)) continue;
      again += g->accel().occluded(
          {offset_ray_origin(surface.position, surface.position_error, surface.geometric_normal, w), 0, w,
           kInfinity});
    }
    EXPECT_EQ(again, 0);
  }
}

TEST(FilmStatistical, VarianceOfTheMeanIsTheSpreadOfMeans) {
  // A coin of 0 and 1 with chance p: variance of the mean p (1 - p) / n, its estimate unbiased.
  constexpr int kSide = 64, kSamples = 16;
  Film film(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int i = 0; i < kSamples; ++i) {
        std::uint64_t h =
            hash_combine(fresh_seed(), static_cast<std::uint64_t>((y * kSide + x) * kSamples + i));
        float u = to_unit_float(static_cast<std::uint32_t>(h));
        film.add(x, y, {u < 0.3f ? 1.0f : 0.0f, u, 5});
      }
  RunningStatistics coin, line;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      vec3 v = film.variance_of_mean(x, y);
      coin.add(static_cast<double>(v.x)), line.add(static_cast<double>(v.y));
      EXPECT_EQ(v.z, 0);
    }
  EXPECT_GT(z_test(coin, 0.3 * 0.7 / kSamples, 1e-7), sidak_threshold(2)) << seed_note();
  EXPECT_GT(z_test(line, 1.0 / 12 / kSamples, 1e-7), sidak_threshold(2)) << seed_note();
}

TEST(Film, FillsTheHolesOfACoarsePass) {
  Film film(5, 3);
  film.add(0, 0, vec3(1));
  film.add(4, 0, vec3(2));
  film.add(1, 1, vec3(7));
  std::vector<vec3> out;
  resolve_view(film, View::radiance, 4, out);
  EXPECT_EQ(out[3], vec3(1));
  EXPECT_EQ(out[4 + 2 * 5], vec3(2));
  EXPECT_EQ(out[1 + 1 * 5], vec3(1)); // of a finer lattice that is not complete: not yet
  EXPECT_EQ(film.image().at(3, 0), vec3(0));
  EXPECT_EQ(film.variance_of_mean(0, 0), vec3(0));
}

TEST(FilterRender, PixelsWeighTheirNeighbourhoodByTheFilter) {
  // An edge of light: what a pixel at distance d sees of the bright half is the filter's integral, which is
  // below 0 and above 1 beside the edge for Mitchell's.
  for (FilterType filter : {FilterType::box, FilterType::tent, FilterType::gaussian,
                            FilterType::blackman_harris, FilterType::mitchell}) {
    SceneMaker s(8, 32, 4096);
    s.rectangle({-50, 0, -1}, {50, 0, 0}, {0, 50, 0}, s.diffuse(vec3(0), vec3(1))); // x < 0 shines
    s.camera({0, 0, 10}, {0, 0, 0}, 10);
    s.document.settings.film.filter = filter;
    s.document.settings.film.filter_radius = 1.8f;
    s.document.settings.sampler.seed = sampler_seed(3);
    Film film = render(s.document);
    for (int x = 0; x < 8; ++x) {
      double inside = std::clamp((4 - (x + 0.5)) / 1.8, -1.0, 1.0); // from the pixel's centre to the edge
      double exact = 0;
      constexpr int kSteps = 10000;
      for (int i = 0; i < kSteps; ++i)
        exact += filter_value(filter, (inside + 1) * (i + 0.5) / kSteps - 1) * (inside + 1) / kSteps;
      exact /= filter_integral(filter);
      double mean = 0;
      for (int y = 0; y < 32; ++y) mean += static_cast<double>(film.mean(x, y).r) / 32;
      EXPECT_NEAR(mean, exact, 2e-3) << static_cast<int>(filter) << ' ' << x << "; " << seed_note();
    }
  }
}

} // namespace
