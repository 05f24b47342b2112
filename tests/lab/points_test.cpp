#include "core/error.h"
#include "lab/lessons.h"
#include "lab/points.h"
#include "sampling/discrepancy.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

TEST(Points, CoordinatesReadBack) {
  for (std::string_view name : dimension_names())
    for (const char* rest : {"", ".x", ".y", "@7", ".x@1", ".y@12"}) {
      const std::string text = std::string(name) + rest;
      EXPECT_EQ(to_string(parse_coordinate("--x", text)), text);
    }
  EXPECT_EQ(parse_coordinate("--x", "bsdf_direction.y@2"),
            (Coordinate{Dimension::bsdf_direction, Coordinate::y, 2}));
}

TEST(Points, WhatIsNoCoordinateIsAUsageError) {
  for (const char* text : {"", "film.z", "films", "film@", "film@-1", "film@x", "film@1x", "@1", ".x",
                           "film.x.y", "film@99999999999"})
    try {
      parse_coordinate("--y", text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find("--y"), std::string::npos);
    }
}

TEST(Points, AreTheRenderersOwn) {
  const SampleSource source{SamplerType::sobol, 5};
  const PointsOptions options{{Dimension::bsdf_direction, Coordinate::y, 3},
                              {Dimension::russian_roulette, Coordinate::one, 1},
                              {4, 9}};
  const auto points = sampler_points(options, source, 10, 20);
  ASSERT_EQ(points.size(), 20u);
  Sampler sampler(SamplerType::sobol, 5);
  for (std::uint32_t i = 0; i < 20; ++i) {
    sampler.start({4, 9}, 10 + i);
    sampler.set_bounce(3);
    EXPECT_EQ(points[i].x, sampler.get_2d(Dimension::bsdf_direction).y);
    sampler.set_bounce(1);
    EXPECT_EQ(points[i].y, sampler.get_1d(Dimension::russian_roulette));
  }
}

TEST(Points, TheCurveIsTheirDiscrepancy) {
  const SampleSource source{SamplerType::independent, 2};
  DiscrepancyCurve curve({}, source, 100);
  while (!curve.finished()) curve.advance();
  std::uint32_t expected = 1;
  for (const auto& value : curve.values()) {
    EXPECT_EQ(value.count, std::min(expected, 100u));
    EXPECT_EQ(value.discrepancy, l2_star_discrepancy(sampler_points({}, source, 0, value.count)));
    expected *= 2;
  }
  EXPECT_EQ(curve.values().size(), 8u);
}

TEST(Lessons, AreFoundByName) {
  for (const LessonInfo& info : lessons()) {
    EXPECT_EQ(&lesson(info.name), &info);
    EXPECT_FALSE(info.look_at.empty());
  }
}

} // namespace
} // namespace candela::test
