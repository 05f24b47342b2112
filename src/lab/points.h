#pragma once
// The lesson `points`: a sampler's points, projected to any two of its dimensions.

#include "lab/source.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// Names of the sampler's dimensions, in Dimension's order.
std::span<const std::string_view> dimension_names();

/// One coordinate of a path's random numbers: a 1D draw, or one component of a 2D draw.
struct Coordinate {
  enum Part { one, x, y };
  Dimension dimension = Dimension::film;
  Part part = x;
  std::uint32_t bounce = 0;
  bool operator==(const Coordinate&) const = default;
};

/// Parses "film.x", "bsdf_direction.y@2" (at bounce 2), "russian_roulette" (a 1D draw). Throws a usage error
/// that names `option`.
Coordinate parse_coordinate(std::string_view option, std::string_view text);
std::string to_string(const Coordinate& coordinate);

struct PointsOptions {
  Coordinate x{Dimension::film, Coordinate::x, 0};
  Coordinate y{Dimension::film, Coordinate::y, 0};
  uvec2 pixel{0};
  bool operator==(const PointsOptions&) const = default;
};

/// Points of samples first, first + 1, …, each in [0, 1)^2.
std::vector<vec2> sampler_points(const PointsOptions& options, const SampleSource& source,
                                 std::uint32_t first, std::uint32_t count);

/// L2 star discrepancy of a growing point set at 1, 2, 4, … points and at the last. A value.
class DiscrepancyCurve {
public:
  struct Value {
    std::uint32_t count;
    double discrepancy;
  };

  DiscrepancyCurve(const PointsOptions& options, SampleSource source, std::uint32_t count)
      : options_(options), source_(source), count_(count) {}

  const PointsOptions& options() const { return options_; }
  const SampleSource& source() const { return source_; }
  bool finished() const { return !values_.empty() && values_.back().count >= count_; }
  /// Computes the next value, in about count^2 operations.
  void advance();
  std::span<const Value> values() const { return values_; }

private:
  PointsOptions options_;
  SampleSource source_;
  std::uint32_t count_;
  std::vector<vec2> points_;
  std::vector<Value> values_;
};

} // namespace candela
