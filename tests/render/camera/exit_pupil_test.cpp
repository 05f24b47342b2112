// The bounds of what a film point sees through a lens, and how much light comes that way.

#include "render/camera/lens_testing.h"

namespace candela::test {
namespace {

bool inside(const PupilEllipse& e, vec2 at) {
  if (!(e.semi_axes.x > 0)) return false;
  const vec2 q = (at - vec2(e.center, 0)) / e.semi_axes;
  return glm::dot(q, q) <= 1;
}

TEST(ExitPupilStatistical, BoundsHoldEveryRayThatPasses) {
  Uniform u(10);
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 5.6f, 16.0f, 64.0f})
      for (float focus : {kInfinity, 1000.0f}) {
        // The last one is vignetted away before the film's corner.
        const float film_radius = lens.key == "fisheye" ? 26.0f : 21.6f;
        const LensSystem system = lens_of(lens, f_stop, focus, film_radius);
        const float rear = system.surfaces().front().radius;
        int passed = 0, outside = 0;
        for (int i = 0; i < 60000; ++i) {
          const float film = film_radius * std::sqrt(u());
          const PupilEllipse bounds = system.exit_pupil_bounds(film);
          // A third anywhere on the last interface, the others about the bounds.
          vec2 at = vec2(2 * u() - 1, 2 * u() - 1);
          at = i % 3 == 0 || !(bounds.semi_axes.x > 0)
                   ? at * 1.5f * rear
                   : vec2(bounds.center, 0) + at * bounds.semi_axes * (i % 3 == 1 ? 1.1f : 2.0f);
          if (!system.trace_from_film(film_ray(system, {film, 0}, at))) continue;
          ++passed;
          outside += !inside(bounds, at);
        }
        EXPECT_GT(passed, 8000) << lens.name;
        EXPECT_EQ(outside, 0) << lens.name << " f/" << f_stop << " at " << focus << "; " << seed_note();
      }
}

TEST(ExitPupilStatistical, FewSamplesAreLost) {
  Uniform u(11);
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 8.0f, 64.0f}) {
      const LensSystem system = lens_of(lens, f_stop, 3000);
      for (float film : {0.0f, 5.0f, 10.0f, 14.0f, 17.4f}) {
        int passed = 0;
        constexpr int kRays = 10000;
        for (int i = 0; i < kRays; ++i) {
          const auto pupil = system.sample_exit_pupil({film, 0}, u.point());
          ASSERT_TRUE(pupil);
          passed += system.trace_from_film(film_ray(system, {film, 0}, pupil->point)).has_value();
        }
        // A rectangle about a disc would lose 21 %.
        EXPECT_GT(passed, (film == 0 ? 0.94 : 0.82) * kRays) << lens.name << " f/" << f_stop << ", " << film;
      }
    }
}

TEST(ExitPupilStatistical, SamplesTurnWithTheFilmPoint) {
  Uniform u(12);
  const LensSystem system = lens_of(*find_lens("double_gauss"));
  for (int i = 0; i < 2000; ++i) {
    const vec2 film = u.in_disc(17), at = u.point();
    const float radius = glm::length(film);
    const auto turned = system.sample_exit_pupil(film, at),
               straight = system.sample_exit_pupil({radius, 0}, at);
    ASSERT_TRUE(turned && straight);
    ASSERT_EQ(turned->area, straight->area);
    const vec2 x = film / radius;
    ASSERT_LT(glm::length(turned->point - (straight->point.x * x + straight->point.y * vec2(-x.y, x.x))),
              1e-4f);
    const PupilEllipse bounds = system.exit_pupil_bounds(radius);
    ASSERT_FLOAT_EQ(turned->area, kPi * bounds.semi_axes.x * bounds.semi_axes.y);
    // The lens is round: so is what it does.
    ASSERT_NEAR(system.sample_weight(film, *turned), system.sample_weight({radius, 0}, *straight), 1e-5f);
  }
  EXPECT_FALSE(system.sample_exit_pupil({18, 0}, {0.5f, 0.5f})) << "beyond the film";
}

TEST(ExitPupilStatistical, WeightsIntegrateTheIrradianceOfTheFilm) {
  // Against points all over the plane z = 0: E = integral of cos^4 / d^2 over what passes, for radiance 1.
  Uniform u(13);
  int tests = 0;
  std::vector<double> p_values;
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 8.0f})
      for (float radius : {0.0f, 8.0f, 16.0f}) {
        const LensSystem system = lens_of(lens, f_stop, 2000);
        const float side = 3.0f * system.surfaces().front().radius, d = system.film_distance();
        const vec2 film(0.6f * radius, -0.8f * radius);
        RunningStatistics sampled, everywhere;
        for (int i = 0; i < 60000; ++i) {
          const auto pupil = system.sample_exit_pupil(film, u.point());
          ASSERT_TRUE(pupil);
          const bool passes = system.trace_from_film(film_ray(system, film, pupil->point)).has_value();
          sampled.add(passes ? static_cast<double>(system.sample_weight(film, *pupil)) : 0);
          const vec2 at(side * (u() - 0.5f), side * (u() - 0.5f));
          const LensRay ray = film_ray(system, film, at);
          const double cos4 = std::pow(static_cast<double>(ray.direction.z), 4);
          everywhere.add(system.trace_from_film(ray)
                             ? cos4 * static_cast<double>(sqr(side / d) / system.axial_exposure())
                             : 0);
        }
        ++tests;
        p_values.push_back(z_test(sampled, everywhere));
        EXPECT_NEAR(sampled.mean(), system.relative_illumination(radius), 4e-3) << lens.name;
      }
  for (double p : p_values) EXPECT_GT(p, sidak_threshold(tests)) << seed_note();
}

TEST(LensSystem, TheMiddleOfTheFilmIsExposedAsByAThinLens) {
  for (const LensPrescription& lens : kLenses)
    for (float f_stop : {0.0f, 5.6f, 22.0f}) {
      const LensSystem infinity = lens_of(lens, f_stop);
      EXPECT_NEAR(infinity.relative_illumination(0), 1, 2e-3) << lens.name << " f/" << f_stop;
      // Stopped down, pi / (4 N^2) (the sine condition).
      const double n = static_cast<double>(infinity.f_number());
      EXPECT_NEAR(static_cast<double>(infinity.axial_exposure()) * 4 * n * n / std::numbers::pi, 1,
                  n > 20 ? 4e-3 : 0.08)
          << lens.name;
      if (f_stop < 22) continue;
      // A nearer focus draws the film away: the cone narrows to N (1 + m / p), m the magnification and p the
      // exit pupil's over the entrance pupil's size.
      const LensSystem near = lens_of(lens, f_stop, 12 * lens.focal_length);
      const double f = near.focal_length();
      const double object = static_cast<double>(near.focus_distance()) + near.entrance_pupil().z -
                            near.cardinal_points().front_focus;
      const double p = near.exit_pupil().radius / near.entrance_pupil().radius;
      EXPECT_NEAR(near.relative_illumination(0), std::pow(1 + f / object / p, -2), 4e-3) << lens.name;
    }
}

TEST(LensSystem, VignettingDarkensTheFilmOutwards) {
  for (const LensPrescription& lens : kLenses) {
    const LensSystem open = lens_of(lens), stopped = lens_of(lens, 16);
    double before = 1.001;
    for (float radius = 0; radius < 17.5f; radius += 2.5f) {
      const double now = open.relative_illumination(radius);
      EXPECT_LT(now, before + 1e-3) << lens.name << " at " << radius;
      EXPECT_GT(now, 0.1);
      EXPECT_LT(now, stopped.relative_illumination(radius) + 2e-3) << "less of it when stopped down";
      before = now;
    }
    EXPECT_LT(open.relative_illumination(17.4f), lens.key == "telephoto" ? 0.985 : 0.5) << lens.name;
  }
  // Well stopped down nothing but the cosine is left: that of the line from the film to the exit pupil. The
  // fisheye's moves and tilts.
  for (std::string_view key : {"double_gauss", "wide_angle", "telephoto"}) {
    const LensSystem system = lens_of(*find_lens(key), 45);
    const double distance = static_cast<double>(system.film_distance()) + system.exit_pupil().z;
    for (float radius : {5.0f, 10.0f}) {
      const double cosine = distance / std::hypot(distance, static_cast<double>(radius));
      EXPECT_NEAR(system.relative_illumination(radius), std::pow(cosine, 4), 0.04) << key << ' ' << radius;
    }
  }
  // Beyond its circle the fisheye shows nothing.
  EXPECT_EQ(lens_of(*find_lens("fisheye"), 0, kInfinity, 40).relative_illumination(35), 0);
}

TEST(LensSystem, BladesCutTheStopAndKeepTheExposure) {
  const LensPrescription& lens = *find_lens("double_gauss");
  for (int blades : {3, 5, 8}) {
    const float rotation = 0.3f;
    const LensSystem system(lens.interfaces,
                            {.focal_length = 50, .f_stop = 16, .blades = blades, .blade_rotation = rotation});
    EXPECT_NEAR(system.relative_illumination(0), 1, 0.01);
    // Through a corner of the stop's polygon, and not through the middle of a side.
    for (int i = 0; i < 2 * blades; ++i) {
      const float angle = rotation + kPi / 2 + kPi * static_cast<float>(i) / static_cast<float>(blades);
      const vec2 towards(std::cos(angle), std::sin(angle));
      const auto rim = 0.97f * static_cast<float>(system.entrance_pupil().radius);
      const bool passes =
          system.trace_from_scene({vec3(rim * towards, system.front_vertex() + 50), {0, 0, -1}}).has_value();
      EXPECT_EQ(passes, i % 2 == 0) << blades << " blades, " << i;
    }
  }
}

} // namespace
} // namespace candela::test
