// Curves as surfaces: what strands become, normals and coordinates of hits, rays that leave, and hair on
// them.

#include "render/integrators/transport.h"
#include "render/render_testing.h"

#include <set>

namespace candela::test {
namespace {

CurvesShape shape_of(Strands strands, CurveForm form) {
  CurvesShape shape;
  shape.strands = std::make_shared<const Strands>(std::move(strands));
  shape.form = static_cast<int>(form);
  return shape;
}

Strands straight_strand(vec3 from, vec3 to, float width) {
  Strands s;
  s.basis = CurveBasis::bezier;
  for (int k = 0; k < 4; ++k) s.points.push_back(glm::mix(from, to, static_cast<float>(k) / 3));
  s.counts = {4};
  s.widths = {width, width};
  return s;
}

/// A B-spline that winds up.
Strands curl(vec3 from, float width, float tip_width) {
  Strands s;
  for (int k = 0; k < 9; ++k) {
    const auto x = static_cast<float>(k);
    s.points.push_back(from + vec3(0.25f * std::cos(1.1f * x), 0.2f * x, 0.25f * std::sin(1.1f * x)));
  }
  s.counts = {9};
  s.widths = {width, tip_width};
  return s;
}

std::shared_ptr<const Geometry> geometry_of(const CurvesShape& shape, const mat4& m = mat4(1)) {
  return Geometry::build({Instance{"", shape, m, {0}}});
}

TEST(CurveSurfaces, BSplinesArePiecesOfTheirBlend) {
  // Against the blending functions of the uniform cubic B-spline (de Boor), from the pieces' ends.
  const Strands s = curl({1, -1, 0}, 0.02f, 0.02f);
  const auto g = geometry_of(shape_of(s, CurveForm::round));
  const CurveSurfaces& curves = g->curves();
  ASSERT_GE(curves.segments.size(), 6u);
  for (std::size_t i = 0; i < curves.segments.size(); ++i) {
    const double at = std::min(static_cast<double>(curves.parts[i].u_begin) * 6, 6.0);
    const auto k = static_cast<std::size_t>(std::min(std::floor(at + 1e-6), 5.0));
    const double t = at - static_cast<double>(k);
    const double weight[] = {std::pow(1 - t, 3) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                             (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
    glm::dvec3 expected(0);
    for (std::size_t j = 0; j < 4; ++j) expected += weight[j] * glm::dvec3(s.points[k + j]);
    EXPECT_LT(glm::length(expected - glm::dvec3(curves.segments[i].points[0])), 1e-6);
    EXPECT_NEAR(curves.segments[i].points[0].w, 0.01f, 1e-8f);
    if (i > 0) { EXPECT_EQ(curves.segments[i].points[0], curves.segments[i - 1].points[3]); }
    const bool first = i == 0, last = i + 1 == curves.segments.size();
    EXPECT_EQ((curves.segments[i].flags & CurveSegment::closed_start) != 0, first);
    EXPECT_EQ((curves.segments[i].flags & CurveSegment::closed_end) != 0, last);
  }
}

TEST(CurveSurfaces, WidthsAreLinearOrBlended) {
  Strands s = curl({0, 0, 0}, 0.06f, 0.01f);
  for (bool per_point : {false, true}) {
    if (per_point) {
      s.widths.clear();
      for (int k = 0; k < 9; ++k)
        s.widths.push_back(0.1f - 0.01f * static_cast<float>(k)); // linear once more
    }
    const auto g = geometry_of(shape_of(s, CurveForm::round));
    const CurveSurfaces& c = g->curves();
    for (std::size_t i = 0; i < c.segments.size(); ++i) {
      const float expected = per_point ? glm::mix(0.045f, 0.015f, c.parts[i].u_begin)
                                       : glm::mix(0.03f, 0.005f, c.parts[i].u_begin);
      EXPECT_NEAR(c.segments[i].points[0].w, expected, 1e-6f);
    }
  }
  // Tubes stay round: the transform's mean scale is theirs.
  const CurvesShape shape = shape_of(straight_strand({0, 0, 0}, {0, 0, 1}, 0.1f), CurveForm::round);
  const auto g = geometry_of(shape, glm::scale(mat4(1), {2, 4, 1}));
  EXPECT_NEAR(g->curves().segments[0].points[0].w, 0.05f * 2, 1e-6f);
}

TEST(CurveSurfaces, CornersAreClosedAndBendsAreNot) {
  Strands s;
  s.basis = CurveBasis::bezier;
  s.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0},
              {5, 1, 0}, {6, 2, 0}, {6, 3, 0}, {7, 3, 0}, {8, 3, 0}};
  s.counts = {10};
  s.widths = {0.9f, 0.9f};
  const auto g = geometry_of(shape_of(s, CurveForm::round));
  std::vector<bool> closed_at_start;
  for (const CurveSegment& c : g->curves().segments)
    closed_at_start.push_back(c.flags & CurveSegment::closed_start);
  ASSERT_EQ(closed_at_start.size(), 3u);
  EXPECT_EQ(closed_at_start, (std::vector<bool>{true, false, true}));
  // Outside of the corner, where neither tube is, the ball is hit.
  EXPECT_TRUE(g->accel().intersect({{6.3f, 1.8f, 5}, 0, {0, 0, -1}, kInfinity}));
}

TEST(CurveSurfaces, ATubeHasTheNormalsAndCoordinatesOfACylinder) {
  const float r = 0.05f;
  const auto g = geometry_of(shape_of(straight_strand({0, 0, 0}, {0, 2, 0}, 2 * r), CurveForm::round));
  for (float offset : {-0.98f, -0.7f, -0.2f, 0.0f, 0.4f, 0.9f}) {
    const Ray ray{{offset * r, 0.5f, 3}, 0, {0, 0, -1}, kInfinity};
    const auto hit = g->accel().intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->kind, PrimitiveKind::curve);
    const SurfaceInteraction s = g->surface(ray, *hit);
    const float depth = std::sqrt(1 - offset * offset);
    EXPECT_LT(glm::length(s.geometric_normal - vec3(offset, 0, depth)), 1e-5f);
    EXPECT_LT(glm::length(s.position - vec3(offset * r, 0.5f, depth * r)), 1e-6f);
    const vec2 uv = g->uv(ray, *hit);
    EXPECT_NEAR(uv.x, 0.25f, 1e-6f);
    const vec3 across = glm::cross(vec3(0, 1, 0), ray.direction);
    EXPECT_NEAR(2 * uv.y - 1, offset * across.x, 1e-4f);
    const SurfaceTangents t = g->tangents(ray, *hit);
    EXPECT_TRUE(t.has_uv);
    EXPECT_LT(glm::length(t.dpdu - vec3(0, 2, 0)), 1e-4f);
    // The offset that a hair takes from the normal alone is the same.
    const Basis frame = Basis::from_normal(s.shading_normal);
    const vec3 wo = frame.to_local(-ray.direction);
    const vec2 axis = glm::normalize(vec2(frame.to_local(t.dpdu)));
    const vec3 turned(wo.x * axis.x + wo.y * axis.y, wo.y * axis.x - wo.x * axis.y, wo.z);
    EXPECT_NEAR(Hair::offset_on_cylinder(turned), 2 * uv.y - 1, 1e-4f);
  }
}

TEST(CurveSurfaces, HitsTellTheirShapeForPickingAndMaterials) {
  const CurvesShape shape = shape_of(straight_strand({0, -1, 0}, {0, 1, 0}, 0.1f), CurveForm::round);
  const auto g = Geometry::build({Instance{"", shape, glm::translate(mat4(1), {-1, 0, 0}), {3}},
                                  Instance{"", SphereShape{0.2f}, mat4(1), {1}},
                                  Instance{"", shape, glm::translate(mat4(1), {1, 0, 0}), {2}}});
  const float x[] = {-1, 0, 1};
  const std::uint32_t material[] = {3, 1, 2};
  std::set<std::uint64_t> numbers;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Ray ray{{x[i], 0.1f, 5}, 0, {0, 0, -1}, kInfinity};
    const auto hit = g->accel().intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_EQ(g->instance_of(*hit), i);
    EXPECT_EQ(g->material_of(*hit), material[i]);
    const SurfaceInteraction s = g->surface(ray, *hit);
    EXPECT_EQ(s.material, material[i]);
    EXPECT_LT(s.emitter, g->emitter_count());
    numbers.insert(s.emitter);
    const Hit again = g->hit_at(s.emitter, s.position);
    EXPECT_EQ(again.kind, hit->kind);
    EXPECT_EQ(again.primitive, hit->primitive);
    EXPECT_NEAR(again.u, hit->u, 1e-5f);
  }
  EXPECT_EQ(numbers.size(), 3u);
}

TEST(CurveSurfaces, HairLearnsItsDirectionAndOffset) {
  Material hair = material_of_type("hair");
  const Bsdf bsdf = make_bsdf(hair);
  for (CurveForm form : {CurveForm::round, CurveForm::ribbon}) {
    const auto g = geometry_of(shape_of(straight_strand({0, 0, 0}, {0, 2, 0}, 0.1f), form));
    for (float offset : {-0.8f, 0.3f}) {
      const Ray ray{{offset * 0.05f, 1.8f, 3}, 0, glm::normalize(vec3(0, -0.4f, -1)), kInfinity};
      const auto hit = g->accel().intersect(ray);
      ASSERT_TRUE(hit);
      const SurfaceInteraction s = g->surface(ray, *hit);
      Bsdf turned = bsdf;
      orient_bsdf(turned, *g, ray, *hit, s.shading_normal);
      const auto& model = std::get<Turned<Hair>>(turned);
      EXPECT_NEAR(model.closure.h, -offset, 1e-4f) << "along cross(wo, +x), which is -x here";
      const Basis frame = Basis::from_normal(s.shading_normal);
      EXPECT_NEAR(frame.to_world(vec3(model.axis, 0)).y, glm::length(vec2(frame.to_local(vec3(0, 1, 0)))),
                  1e-4f);
      if (form == CurveForm::ribbon) {
        EXPECT_LT(glm::length(s.geometric_normal - vec3(0, 0, 1)), 1e-5f)
            << "it faces the ray, across the strand";
      }
    }
  }
}

TEST(CurveSurfaces, TangentsTellHowTheCoordinatesChange) {
  for (CurveForm form : {CurveForm::round, CurveForm::ribbon}) {
    const auto g = geometry_of(shape_of(curl({0, 0, 0}, 0.03f, 0.025f), form));
    int checked = 0;
    for (float y = 0.3f; y < 1.3f; y += 0.01f)
      for (float x = -0.25f; x < 0.25f; x += 0.003f) {
        const vec3 along(0, 0, -1);
        const Ray ray{{x, y, 3}, 0, along, kInfinity};
        const auto hit = g->accel().intersect(ray);
        if (!hit) continue;
        const vec2 uv = g->uv(ray, *hit);
        if (std::abs(uv.y - 0.5f) > 0.35f) continue; // towards the edges they change too quickly
        const SurfaceInteraction s = g->surface(ray, *hit);
        const SurfaceTangents t = g->tangents(ray, *hit);
        ASSERT_TRUE(t.has_uv);
        if (std::abs(glm::normalize(t.dpdu).z) > 0.8f) continue; // seen end-on
        for (vec3 aside : {glm::normalize(t.dpdu), glm::normalize(t.dpdv)}) {
          const Ray beside{ray.origin + 2e-4f * aside, 0, along, kInfinity};
          const auto there = g->accel().intersect(beside);
          if (!there) continue;
          const vec2 step = g->uv(beside, *there) - uv;
          const vec3 real = g->surface(beside, *there).position - s.position;
          if (glm::length(real) > 2e-3f) continue; // another coil
          const vec3 predicted = t.dpdu * step.x + t.dpdv * step.y;
          ++checked;
          // The ribbon turns with the strand, which the derivatives in its own plane do not say.
          EXPECT_LT(glm::length(predicted - real), 0.1f * glm::length(real)) << x << ' ' << y;
        }
      }
    EXPECT_GT(checked, 100);
  }
}

TEST(CurveSurfacesStatistical, RaysThatLeaveDoNotMeetWhereTheyBegin) {
  const std::uint64_t seed = fresh_seed();
  SCOPED_TRACE(seed_note());
  auto random = [&, n = std::uint64_t{0}]() mutable {
    return to_unit_float(static_cast<std::uint32_t>(hash64(seed + ++n) >> 32));
  };
  auto direction = [&] {
    const float z = 1 - 2 * random(), phi = 2 * kPi * random(), s = safe_sqrt(1 - z * z);
    return vec3(s * std::cos(phi), s * std::sin(phi), z);
  };
  for (CurveForm form : {CurveForm::round, CurveForm::ribbon})
    for (float width : {0.1f, 0.002f})
      for (vec3 place : {vec3(0), vec3(20, -30, 10)}) {
        const vec3 axis = glm::normalize(vec3(1, 2, -0.5f));
        const auto g = geometry_of(shape_of(straight_strand(place - axis, place + axis, width), form));
        int left = 0;
        for (int i = 0; i < 20000; ++i) {
          const vec3 d = direction(), aside = glm::cross(d, axis);
          const vec3 target = place + axis * (1.6f * random() - 0.8f) +
                              0.5f * width * (2 * random() - 1) * glm::normalize(aside);
          const Ray ray{target - 4.0f * d, 0, d, kInfinity};
          const auto hit = g->accel().intersect(ray);
          if (!hit) continue;
          const SurfaceInteraction s = g->surface(ray, *hit);
          const vec3 w = direction();
          if (form == CurveForm::ribbon && std::abs(glm::dot(w, axis)) > 0.999f) continue;
          ++left;
          const auto again = g->accel().intersect(spawn_ray(s, w, 0));
          ASSERT_FALSE(again) << "form " << static_cast<int>(form) << ", width " << width << ", t "
                              << again->t << ", cosine " << glm::dot(w, s.geometric_normal);
        }
        EXPECT_GT(left, 10000);
      }
}

/// A tuft in a furnace: nothing of it is seen.
TEST(CurveFurnaceRender, WhiteHairIsInvisible) {
  Material hair = material_of_type("hair");
  std::get<HairMaterial>(hair.model).parametrization = static_cast<int>(HairAbsorption::absorption);
  color(hair, "sigma_a") = vec3(0);
  for (LightSampling sampling : {LightSampling::bsdf, LightSampling::mis})
    for (CurveForm form : {CurveForm::round, CurveForm::ribbon}) {
      SceneMaker s(24, 24, sampling == LightSampling::bsdf ? 16 : 256);
      Strands tuft;
      tuft.widths = {0.12f, 0.04f};
      for (int i = 0; i < 40; ++i) {
        const auto x = static_cast<float>(i);
        const vec3 from(0.9f * std::sin(2.4f * x), -1, 0.9f * std::cos(1.7f * x));
        const Strands one = curl(from, 0, 0);
        tuft.points.insert(tuft.points.end(), one.points.begin(), one.points.end());
        tuft.counts.push_back(9);
      }
      s.document.scene.instances.push_back({"", shape_of(tuft, form), mat4(1), {s.material(hair)}});
      s.constant_light(vec3(1));
      s.camera({0.5f, 1, 6}, {0, 0, 0}, 25);
      s.document.settings.path.light_sampling = sampling;
      s.document.settings.path.rr = RussianRoulette::off;
      s.document.settings.path.max_depth = 1000000;
      s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(form));
      const Film film = render(s.document);
      if (sampling == LightSampling::bsdf) { // no noise
        for (int y = 0; y < 24; ++y)
          for (int x = 0; x < 24; ++x)
            ASSERT_NEAR(film.mean(x, y).g, 1, 1e-3f) << x << ' ' << y << ' ' << static_cast<int>(form);
      } else {
        EXPECT_GT(z_test(over_pixels(film, 1), 1, 1e-4), sidak_threshold(4)) << over_pixels(film, 1).mean();
        EXPECT_NEAR(over_pixels(film, 1).mean(), 1, 0.01);
      }
    }
}

TEST(CurveFurnaceRender, GlowingCurvesShineHoweverLightsAreSampled) {
  RunningStatistics means[2];
  for (int nee = 0; nee < 2; ++nee) {
    SceneMaker s(16, 16, 256);
    s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, s.diffuse(vec3(0.5f)));
    s.document.scene.instances.push_back(
        {"",
         shape_of(straight_strand({-1, 0.5f, 0}, {1, 0.5f, 0}, 0.3f), CurveForm::round),
         mat4(1),
         {s.diffuse(vec3(0), vec3(2))}});
    s.camera({0, 4, 0.1f}, {0, 0, 0}, 10);
    s.document.settings.path.max_depth = 2;
    s.document.settings.path.light_sampling = nee == 1 ? LightSampling::nee : LightSampling::bsdf;
    s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(nee) + 7);
    means[nee] = over_pixels(render(s.document), 0);
  }
  EXPECT_GT(means[0].mean(), 0.2);
  EXPECT_GT(z_test(means[0], means[1], 1e-4), sidak_threshold(1))
      << means[0].mean() << ' ' << means[1].mean();
}

} // namespace
} // namespace candela::test
