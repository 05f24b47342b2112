#include "lab/points.h"

#include "core/error.h"
#include "core/fields.h"
#include "sampling/discrepancy.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace candela {

namespace {

constexpr std::array kDimensionNames = std::to_array<std::string_view>(
    {"film", "lens", "light_position", "bsdf_lobe", "bsdf_direction", "russian_roulette", "opacity", "time",
     "medium_distance", "medium_direct", "medium_pivot", "medium_tracking", "subsurface_probe",
     "subsurface_point"});
static_assert(kDimensionNames.size() == static_cast<std::size_t>(Dimension::count),
              "name the new dimension, in Dimension's order");

float value_of(const Coordinate& coordinate, const Sampler& sampler) {
  if (coordinate.part == Coordinate::one) return sampler.get_1d(coordinate.dimension);
  const vec2 u = sampler.get_2d(coordinate.dimension);
  return coordinate.part == Coordinate::x ? u.x : u.y;
}

} // namespace

std::span<const std::string_view> dimension_names() { return kDimensionNames; }

Coordinate parse_coordinate(std::string_view option, std::string_view text) {
  auto bad = [&](std::string_view cause) {
    return usage_error(fmt::format("{} {}", option, text), cause,
                       fmt::format("write NAME, NAME.x or NAME.y, then @BOUNCE if not at the camera; NAME is "
                                   "one of {}",
                                   fmt::join(kDimensionNames, ", ")));
  };
  Coordinate out;
  std::string_view rest = text;
  if (auto at = rest.find('@'); at != std::string_view::npos) {
    std::string_view digits = rest.substr(at + 1);
    auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), out.bounce);
    if (status != std::errc() || end != digits.data() + digits.size())
      throw bad("the bounce is not a whole number");
    rest = rest.substr(0, at);
  }
  out.part = Coordinate::one;
  if (rest.ends_with(".x"))
    out.part = Coordinate::x;
  else if (rest.ends_with(".y"))
    out.part = Coordinate::y;
  if (out.part != Coordinate::one) rest.remove_suffix(2);
  auto name = std::ranges::find(kDimensionNames, rest);
  if (name == kDimensionNames.end()) throw bad("there is no such dimension");
  out.dimension = static_cast<Dimension>(name - kDimensionNames.begin());
  return out;
}

std::string to_string(const Coordinate& c) {
  constexpr std::string_view kParts[] = {"", ".x", ".y"};
  std::string text = fmt::format("{}{}", kDimensionNames[static_cast<std::size_t>(c.dimension)],
                                 kParts[static_cast<std::size_t>(c.part)]);
  return c.bounce == 0 ? text : fmt::format("{}@{}", text, c.bounce);
}

std::vector<vec2> sampler_points(const PointsOptions& options, const SampleSource& source,
                                 std::uint32_t first, std::uint32_t count) {
  std::vector<vec2> points;
  points.reserve(count);
  Sampler sampler = source.sampler();
  for (std::uint32_t i = first; i < first + count; ++i) {
    sampler.start(options.pixel, i);
    sampler.set_bounce(options.x.bounce);
    const float x = value_of(options.x, sampler);
    sampler.set_bounce(options.y.bounce);
    points.emplace_back(x, value_of(options.y, sampler));
  }
  return points;
}

void DiscrepancyCurve::advance() {
  if (finished()) return;
  const std::uint32_t count = std::min(values_.empty() ? 1 : 2 * values_.back().count, count_);
  const auto have = static_cast<std::uint32_t>(points_.size());
  for (vec2 p : sampler_points(options_, source_, have, count - have)) points_.push_back(p);
  values_.push_back({count, l2_star_discrepancy(points_)});
}

} // namespace candela
