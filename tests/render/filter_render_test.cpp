// What each pixel filter makes of an edge, and that none changes a constant.

#include "render_testing.h"
#include "sampling/filter.h"

namespace {

using namespace candela;
using namespace candela::test;

constexpr FilterType kFilters[] = {FilterType::box, FilterType::tent, FilterType::gaussian,
                                   FilterType::blackman_harris, FilterType::mitchell};

/// A glowing half plane whose edge is seen upright at `edge` pixels from the left of a 12 x 12 film, of
/// radiance 1.
SceneMaker half_plane(FilterType filter, float radius, float edge) {
  SceneMaker s(12, 12, 1024);
  int glow = s.diffuse(vec3(0), vec3(1));
  // A pixel is 0.1 wide at distance 1; the camera looks along +z, upright, so its right is -x.
  float x = -(edge - 6) * 0.1f;
  s.rectangle({x - 50, 0, 1}, {50, 0, 0}, {0, 50, 0}, glow);
  s.rectangle({x - 50, 0, 1}, {0, 50, 0}, {50, 0, 0}, glow); // whichever side glows
  s.camera({0, 0, 0}, {0, 0, 1}, degrees(2 * std::atan(0.6f)));
  s.document.settings.film.filter = filter;
  s.document.settings.film.filter_radius = radius;
  s.document.settings.path.max_depth = 1;
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(filter));
  return s;
}

/// Share of the filter's integral beyond x (in radii).
double share_beyond(FilterType type, double x) {
  constexpr int kSteps = 20000;
  double sum = 0, a = std::clamp(x, -1.0, 1.0);
  for (int i = 0; i < kSteps; ++i) sum += filter_value(type, a + (1 - a) * (i + 0.5) / kSteps);
  return sum * (1 - a) / kSteps / filter_integral(type);
}

TEST(FilterStatistical, AnEdgeIsTheFiltersIntegral) {
  SCOPED_TRACE(seed_note());
  constexpr float kEdge = 5.8f;
  for (FilterType type : kFilters) {
    for (float radius : {0.5f, 2.0f}) {
      Film film = render(half_plane(type, radius, kEdge).document);
      for (int x = 0; x < 12; ++x) {
        RunningStatistics column;
        for (int y = 0; y < 12; ++y) column.add(static_cast<double>(film.mean(x, y).x));
        double exact =
            share_beyond(type, (static_cast<double>(kEdge) - (x + 0.5)) / static_cast<double>(radius));
        // Twelve means of 1024 samples each: their own spread is too rough an estimate of the variance, so it
        // is bounded by that of weights up to 1.15.
        double deviation = 1.15 / std::sqrt(4.0 * 12 * 1024);
        bool constant = exact < 1e-9 || exact > 1 - 1e-9; // all of the samples on one side
        if (constant && type != FilterType::mitchell && type != FilterType::blackman_harris)
          EXPECT_NEAR(column.mean(), exact, 1e-5);
        else
          EXPECT_NEAR(column.mean(), exact, 7 * deviation)
              << static_cast<int>(type) << ' ' << radius << ' ' << x;
      }
      if (type == FilterType::mitchell && radius == 2) { // rings: darker than black, brighter than white
        EXPECT_LT(film.mean(4, 6).x, 0);
        EXPECT_GT(film.mean(7, 6).x, 1);
      }
    }
  }
}

} // namespace
