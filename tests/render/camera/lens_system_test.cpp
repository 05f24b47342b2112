// The optics of a lens system: its paraxial figures, the way of rays, focus, and what its f-stop does.

#include "render/camera/lens_testing.h"

namespace candela::test {
namespace {

constexpr float kPixel = 35.0f / 1200; ///< mm, of a film of 35 mm and about 1000 x 667 pixels

TEST(LensSystem, CardinalPointsAreThoseOfTheMatrix) {
  for (const LensPrescription& lens : kLenses)
    for (float focal_length : {0.0f, lens.focal_length, 35.0f}) {
      const LensSystem system(lens.interfaces, {.focal_length = focal_length});
      const AbcdMatrix m = system_matrix(lens.interfaces);
      const double scale = focal_length > 0 ? static_cast<double>(focal_length) / m.focal_length() : 1;
      double length = 0;
      for (std::size_t i = 0; i + 1 < lens.interfaces.size(); ++i)
        length += scale * static_cast<double>(lens.interfaces[i].thickness);
      const double f = scale * m.focal_length(), small = 1e-5 * f;
      EXPECT_NEAR(m.a * m.d - m.b * m.c, 1, 1e-12);
      const LensSystem::CardinalPoints& c = system.cardinal_points();
      EXPECT_NEAR(c.focal_length, f, small) << lens.name;
      EXPECT_NEAR(c.rear_focus, -scale * m.back_focal_length(), small);
      EXPECT_NEAR(c.front_focus, length + scale * m.front_focal_length(), small);
      EXPECT_NEAR(c.rear_principal, c.rear_focus + f, small);
      EXPECT_NEAR(c.front_principal, c.front_focus - f, small);
      EXPECT_NEAR(static_cast<double>(system.front_vertex()), length, small);
      if (focal_length > 0) { EXPECT_NEAR(system.focal_length(), static_cast<double>(focal_length), small); }
    }
}

TEST(LensSystem, RaysNearTheAxisMeetWhereTheMatrixSays) {
  for (const LensPrescription& lens : kLenses) {
    const LensSystem system = lens_of(lens);
    const double f = system.focal_length(), height = 2e-3 * f;
    // At two heights: spherical aberration grows by the square, and is taken out.
    auto figures = [&](double h) {
      const auto to_film = system.trace_from_scene({vec3(h, 0, system.front_vertex() + 1), {0, 0, -1}});
      const auto to_scene = system.trace_from_film({vec3(h, 0, -1), {0, 0, 1}});
      EXPECT_TRUE(to_film && to_scene);
      const double slope =
          static_cast<double>(to_film->direction.x) / -static_cast<double>(to_film->direction.z);
      const double back =
          static_cast<double>(to_scene->direction.x) / static_cast<double>(to_scene->direction.z);
      return glm::dvec2(-h / slope, -h / back);
    };
    const glm::dvec2 measured = (4.0 * figures(height) - figures(2 * height)) / 3.0;
    EXPECT_NEAR(measured.x, f, 1e-3 * f) << lens.name;
    EXPECT_NEAR(measured.y, f, 1e-3 * f) << lens.name;
  }
}

/// A ray in a plane through the axis by angles: circle and line, asin and Snell's law, in double.
struct Meridional {
  double z, y, angle; ///< of the direction from +z, which points at the scene here, too
  bool lost = false;
};
Meridional trace_by_angles(const LensPrescription& lens, double scale, double stop_diameter, Meridional ray) {
  const std::vector<DoubleRow> rows = rows_of(lens.interfaces);
  double vertex = 0;
  for (std::size_t i = rows.size(); i-- > 0;) {
    if (i + 1 < rows.size()) vertex += scale * rows[i].thickness;
    const double radius = scale * rows[i].radius, center = vertex - radius;
    const double dz = std::cos(ray.angle), dy = std::sin(ray.angle);
    double t;
    if (radius == 0) {
      t = (vertex - ray.z) / dz;
    } else {
      const double b = (ray.z - center) * dz + ray.y * dy;
      const double c = std::pow(ray.z - center, 2) + ray.y * ray.y - radius * radius;
      if (!(b * b >= c)) return {0, 0, 0, true};
      t = -b + (radius > 0 ? 1 : -1) * std::sqrt(b * b - c);
    }
    ray.z += t * dz;
    ray.y += t * dy;
    const double diameter = rows[i].radius == 0 ? stop_diameter : scale * rows[i].diameter;
    if (2 * std::abs(ray.y) > diameter) return {0, 0, 0, true};
    if (radius == 0) continue;
    const double normal = std::asin(ray.y / radius); // its angle from +z on a convex side, towards the scene
    const double sine = std::sin(ray.angle - normal) * rows[i].eta / (i > 0 ? rows[i - 1].eta : 1);
    if (std::abs(sine) > 1) return {0, 0, 0, true};
    ray.angle = normal + std::asin(sine);
  }
  return ray;
}

TEST(LensSystemStatistical, RaysGoWhereSnellsLawSendsThem) {
  Uniform u(1);
  for (const LensPrescription& lens : kLenses) {
    const LensSystem system = lens_of(lens, 4);
    const double scale = system.focal_length() / system_matrix(lens.interfaces).focal_length();
    const float rear = system.surfaces().front().radius;
    int passed = 0, differ = 0;
    for (int i = 0; i < 20000; ++i) {
      const vec2 film(u(-17, 17), 0), at(1.2f * u(-rear, rear), 0);
      const LensRay start = film_ray(system, film, at);
      const auto out = system.trace_from_film(start);
      const double angle =
          std::atan2(static_cast<double>(at.x - film.x), static_cast<double>(system.film_distance()));
      const Meridional expected =
          trace_by_angles(lens, scale, static_cast<double>(system.stop_diameter()),
                          {-static_cast<double>(system.film_distance()), static_cast<double>(film.x), angle});
      differ += out.has_value() == expected.lost;
      if (!out || expected.lost) continue;
      ++passed;
      ASSERT_NEAR(static_cast<double>(out->origin.x), expected.y, 1e-6 * system.focal_length() + 1e-4)
          << lens.name;
      ASSERT_NEAR(static_cast<double>(out->origin.z), expected.z, 1e-6 * system.focal_length() + 1e-4);
      ASSERT_NEAR(static_cast<double>(out->direction.x), std::sin(expected.angle), 2e-6);
      ASSERT_EQ(out->direction.y, 0);
    }
    EXPECT_GT(passed, 2000) << lens.name;
    EXPECT_LE(differ, 10) << lens.name << ": at the rims only; " << seed_note();
  }
}

TEST(LensSurface, IsCrossedFromTheRightSideOnly) {
  const LensSurface<double> bowl{0, 0.1, 1, 1, 9.9, false}, plane{0, 0, 1, 1, 9.9, false};
  auto crosses = [](const LensSurface<double>& s, glm::dvec3 p, glm::dvec3 d, bool clip = true) {
    d = glm::normalize(d);
    return cross_lens_surface<true>(s, p, d, clip);
  };
  EXPECT_TRUE(crosses(bowl, {1, 2, -3}, {0.1, 0, 1}));
  EXPECT_TRUE(crosses(plane, {1, 2, -3}, {0.1, 0, 1}));
  EXPECT_FALSE(crosses(bowl, {20, 0, 14.9}, {-1, 0, 0.01})) << "meets the other half of its sphere";
  EXPECT_FALSE(crosses(plane, {1, 2, 3}, {0.1, 0, 1})) << "lies behind the ray";
  EXPECT_FALSE(crosses(bowl, {1, 2, -3}, {0.1, 0, -1}));
  EXPECT_FALSE(crosses(plane, {9, 9, -3}, {0, 0, 1})) << "beside the opening";
  EXPECT_TRUE(crosses(plane, {9, 9, -3}, {0, 0, 1}, false));
  EXPECT_FALSE(crosses(bowl, {9, 9, -3}, {0, 0, 1}, false)) << "beside the sphere";
}

TEST(LensSystem, RaysAlongTheAxisGoStraight) {
  for (const LensPrescription& lens : kLenses) {
    const LensSystem system = lens_of(lens);
    const auto out = system.trace_from_film({{0, 0, -system.film_distance()}, {0, 0, 1}});
    ASSERT_TRUE(out);
    EXPECT_EQ(out->direction, vec3(0, 0, 1));
    EXPECT_EQ(vec2(out->origin), vec2(0));
    EXPECT_FLOAT_EQ(out->origin.z, system.front_vertex());
    EXPECT_EQ(system.trace_from_scene({{0, 0, 1000}, {0, 0, -1}})->direction, vec3(0, 0, -1));
    EXPECT_FALSE(system.trace_from_film({{0, 0, -5}, {0, 0, -1}})) << "away from the lens";
    EXPECT_FALSE(system.trace_from_film({{0, 0, -5}, {1, 0, 0}}));
    EXPECT_FALSE(system.trace_from_scene({{500, 0, 1000}, {0, 0, -1}})) << "beside it";
  }
}

TEST(LensSystemStatistical, TheWayBackIsTheSame) {
  Uniform u(2);
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 11.0f}) {
      const LensSystem system = lens_of(lens, f_stop, 1500);
      int passed = 0, lost = 0;
      for (int i = 0; i < 50000; ++i) {
        const vec2 film = u.in_disc(17.5f);
        const auto pupil = system.sample_exit_pupil(film, u.point());
        if (!pupil) continue;
        const LensRay start = film_ray(system, film, pupil->point);
        const auto out = system.trace_from_film(start);
        if (!out) continue;
        ++passed;
        ASSERT_NEAR(glm::length(out->direction), 1, 1e-6f);
        const auto back = system.trace_from_scene({out->origin + 10.0f * out->direction, -out->direction});
        if (!back) { // on the rim of an opening
          ++lost;
          continue;
        }
        ASSERT_LT(glm::length(back->direction + start.direction), 1e-5f);
        ASSERT_LT(glm::length(at_plane(*back, static_cast<double>(-system.film_distance())) - film), 1e-3f);
      }
      EXPECT_GT(passed, 30000) << lens.name;
      EXPECT_LE(lost, 10) << lens.name << "; " << seed_note();
    }
}

TEST(LensSystem, AReversedLensSendsRaysTheSameWay) {
  // Turned round, as a table that begins at the other end, it does what the way back did. Both ends in air.
  for (const LensPrescription& lens : kLenses) {
    std::vector<LensInterface> reversed;
    for (std::size_t i = lens.interfaces.size(); i-- > 0;) {
      const LensInterface& row = lens.interfaces[i];
      reversed.push_back({-row.curvature_radius, i > 0 ? lens.interfaces[i - 1].thickness : 0,
                          i > 0 ? lens.interfaces[i - 1].eta : 1, row.aperture_diameter});
    }
    const AbcdMatrix m = system_matrix(lens.interfaces), r = system_matrix(reversed);
    EXPECT_NEAR(m.focal_length(), r.focal_length(), 1e-9 * m.focal_length());
    EXPECT_NEAR(m.front_focal_length(), r.back_focal_length(), 1e-9 * m.focal_length());
    if (!lens_problem(reversed).empty()) continue; // a retrofocus lens has its front focus inside
    const LensSystem ahead(lens.interfaces, {}), behind(reversed, {});
    const vec3 start(1, 0.5f, -2), direction = glm::normalize(vec3(0.02f, -0.01f, 1));
    const auto a = ahead.trace_from_film({start, direction});
    const auto b = behind.trace_from_scene(
        {{start.x, start.y, behind.front_vertex() - start.z}, {direction.x, direction.y, -direction.z}});
    ASSERT_TRUE(a && b);
    EXPECT_LT(glm::length(vec2(a->direction) - vec2(b->direction)), 2e-6f);
    EXPECT_LT(glm::length(vec2(a->origin) - vec2(b->origin)), 1e-4f);
  }
}

/// RMS distance on the film from the axis of rays from a point of it, uniform over the entrance pupil.
double spot_size(const LensSystem& system, double distance, double film_z, double* largest = nullptr) {
  constexpr int kRays = 400;
  double sum = 0;
  int passed = 0;
  for (int i = 0; i < kRays; ++i) {
    const double radius = 0.999 * system.entrance_pupil().radius * std::sqrt((i + 0.5) / kRays);
    const auto out = system.trace_from_scene(ray_from_axis(system, distance, vec2(0, radius)));
    if (!out) continue;
    ++passed;
    const double r = static_cast<double>(glm::length(at_plane(*out, film_z)));
    sum += r * r;
    if (largest != nullptr) *largest = std::max(*largest, r);
  }
  EXPECT_GT(passed, kRays / 2);
  return std::sqrt(sum / passed);
}

TEST(LensSystem, APointInFocusGathersToAPixel) {
  for (const LensPrescription& lens : kLenses)
    for (double focus : {1500.0, 4000.0, 1e5, std::numeric_limits<double>::infinity()}) {
      for (float f_stop : {8.0f, 22.0f}) {
        const LensSystem system = lens_of(lens, f_stop, static_cast<float>(focus));
        double largest = 0;
        const double film = -static_cast<double>(system.film_distance());
        spot_size(system, focus, film, &largest);
        // The long lens is not corrected for near objects.
        EXPECT_LT(largest, static_cast<double>(kPixel)) << lens.name << " f/" << f_stop << " at " << focus;
      }
      const LensSystem open = lens_of(lens, 0, static_cast<float>(focus));
      const double film = -static_cast<double>(open.film_distance());
      const double best = spot_size(open, focus, film);
      EXPECT_LT(best, static_cast<double>(kPixel)) << lens.name << " wide open at " << focus;
      for (double off : {-0.1, 0.1}) EXPECT_GT(spot_size(open, focus, film + off), best) << lens.name;
    }
}

TEST(LensSystem, StoppedDownItIsFocusedWhereTheThickLensSays) {
  for (const LensPrescription& lens : kLenses)
    for (float focus : {800.0f, 1500.0f, 5000.0f, kInfinity}) {
      const LensSystem system = lens_of(lens, 90, focus);
      if (focus > 4 * lens.focal_length) { EXPECT_FLOAT_EQ(system.focus_distance(), focus); }
      const AbcdMatrix m = system_matrix(lens.interfaces);
      const double f = static_cast<double>(lens.focal_length), scale = f / m.focal_length();
      // Newton: x x' = f^2, from the focal points.
      const double front_focus = static_cast<double>(system.front_vertex()) + scale * m.front_focal_length();
      const double object =
          system.entrance_pupil().z + static_cast<double>(system.focus_distance()) - front_focus;
      const double image = scale * m.back_focal_length() + f * f / object;
      EXPECT_NEAR(static_cast<double>(system.film_distance()), image, 1e-4 * f) << lens.name << ' ' << focus;
    }
  // A lens whose front lets so little of the pupil pass that there is nothing to refine with.
  const LensInterface narrow[] = {{50, 2, 1.5f, 0.5f}, {-50, 1, 1, 30}, {0, 0, 1, 24}};
  const LensSystem thick(narrow, {.focus_distance = 400});
  const LensSystem::CardinalPoints& c = thick.cardinal_points();
  const double object = thick.entrance_pupil().z + 400 - c.front_focus;
  EXPECT_NEAR(static_cast<double>(thick.film_distance()),
              -c.rear_focus + c.focal_length * c.focal_length / object, 1e-3);
  const LensSystem macro = lens_of(kLenses[0], 0, 10); // nearer than it can be focused
  EXPECT_NEAR(static_cast<double>(macro.focus_distance()) + macro.entrance_pupil().z -
                  macro.cardinal_points().front_principal,
              3 * macro.focal_length(), 1e-3);
}

TEST(LensSystem, FStopsAreTheFocalLengthOverTheBeam) {
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 8.0f, 16.0f, 32.0f}) {
      const LensSystem system = lens_of(lens, f_stop);
      EXPECT_EQ(system.f_number(), std::max(f_stop, system.widest_f_number()));
      EXPECT_NEAR(system.entrance_pupil().radius,
                  system.focal_length() / (2 * static_cast<double>(system.f_number())), 1e-4);
      if (f_stop < 16) continue;                               // else pupils have aberrations
      float inside = 0, outside = system.front_vertex() + 100; // the widest parallel ray that passes
      for (int i = 0; i < 40; ++i) {
        const float h = 0.5f * (inside + outside);
        const bool passes =
            system.trace_from_scene({{0, h, system.front_vertex() + 50}, {0, 0, -1}}).has_value();
        (passes ? inside : outside) = h;
      }
      EXPECT_NEAR(static_cast<double>(inside), system.entrance_pupil().radius,
                  0.01 * system.entrance_pupil().radius)
          << lens.name;
    }
  // Smith's f-numbers.
  EXPECT_NEAR(lens_of(kLenses[0]).widest_f_number(), 2, 0.05f);
  EXPECT_NEAR(lens_of(kLenses[2]).widest_f_number(), 5.6f, 0.2f);
  EXPECT_NEAR(lens_of(kLenses[3]).widest_f_number(), 4, 0.1f);
}

TEST(LensSystem, CircleOfConfusionIsTheThinLens) {
  // A point at D before a lens that is focused at F blurs in the plane in focus to A |D - F| / D.
  for (const LensPrescription& lens : kLenses)
    for (float focal_lengths : {15.0f, 50.0f})
      for (double at : {0.5, 0.8, 1.3, 3.0, 30.0}) {
        const LensSystem system = lens_of(lens, 32, focal_lengths * lens.focal_length);
        const double f = static_cast<double>(system.focus_distance()), d = at * f;
        double inside = 0, outside = 2 * system.entrance_pupil().radius, radius = 0;
        for (int i = 0; i < 30; ++i) {
          const double h = 0.5 * (inside + outside);
          const auto out = system.trace_from_scene(ray_from_axis(system, d, vec2(h, 0)));
          if (out)
            radius =
                std::abs(static_cast<double>(at_plane(*out, -static_cast<double>(system.film_distance())).x));
          (out ? inside : outside) = h;
        }
        const double magnification =
            system.focal_length() / (f + system.entrance_pupil().z - system.cardinal_points().front_focus);
        const double expected = 2 * system.entrance_pupil().radius * std::abs(d - f) / d;
        const double aberrations = 2e-4 + 2.5e-6 * system.focal_length(); // mm, below 1/30 of a pixel
        EXPECT_NEAR(2 * radius, magnification * expected, 0.01 * magnification * expected + aberrations)
            << lens.name << ' ' << focal_lengths << ' ' << at;
        EXPECT_GT(magnification * expected, 8 * aberrations);
      }
}

TEST(LensSystem, APathForDrawingHasAPointOfEachInterface) {
  for (const LensPrescription& lens : kLenses) {
    const LensSystem system = lens_of(lens);
    const LensRay start = film_ray(system, {2, 1}, {0.3f, 0.2f});
    const auto out = system.trace_from_film(start);
    const std::vector<vec3> path = system.path_from_film(start);
    ASSERT_TRUE(out);
    ASSERT_EQ(path.size(), lens.interfaces.size());
    EXPECT_EQ(path.back(), out->origin);
    for (std::size_t i = 0; i < path.size(); ++i) { // on the spheres
      const LensSurface<float>& s = system.surfaces()[i];
      const vec3 p = path[i] - vec3(0, 0, s.z);
      EXPECT_NEAR(s.curvature * glm::dot(p, p), 2 * p.z, 1e-4f);
      EXPECT_LE(glm::length(vec2(p)), s.radius);
    }
    const LensRay lost = film_ray(system, {17, 0}, {-0.99f * system.surfaces().front().radius, 0});
    EXPECT_FALSE(system.trace_from_film(lost));
    EXPECT_LE(system.path_from_film(lost).size(), lens.interfaces.size());
  }
}

TEST(LensSystem, EqualOnesAreShared) {
  const LensSetup setup{.focal_length = 50, .f_stop = 4};
  const auto first = LensSystem::shared(kDoubleGaussTable, setup);
  EXPECT_EQ(first, LensSystem::shared(kDoubleGaussTable, setup));
  EXPECT_NE(first, LensSystem::shared(kDoubleGaussTable, {.focal_length = 50, .f_stop = 5.6f}));
  EXPECT_NE(first, LensSystem::shared(kFisheyeTable, setup));
  EXPECT_EQ(first, LensSystem::shared(std::vector(kDoubleGaussTable, std::end(kDoubleGaussTable)), setup));
}

} // namespace
} // namespace candela::test
