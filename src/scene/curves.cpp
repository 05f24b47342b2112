#include "scene/curves.h"

#include <fmt/format.h>

namespace candela {

std::size_t curve_segments(CurveBasis basis, std::size_t points) {
  if (points < 4) return 0;
  if (basis == CurveBasis::bspline) return points - 3;
  return points % 3 == 1 ? points / 3 : 0;
}

std::size_t Strands::segment_count() const {
  std::size_t sum = 0;
  for (const std::uint32_t count : counts) sum += curve_segments(basis, count);
  return sum;
}

std::string strands_problem(const Strands& strands) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < strands.counts.size(); ++i) {
    if (curve_segments(strands.basis, strands.counts[i]) == 0)
      return fmt::format("counts: strand {} has {} control points, but {}", i, strands.counts[i],
                         strands.basis == CurveBasis::bspline ? "a B-spline takes 4 or more"
                                                              : "Bezier curves take 4, 7, 10 …");
    total += strands.counts[i];
  }
  if (total != strands.points.size())
    return fmt::format("points: there are {} for strands of {}", strands.points.size(), total);
  for (std::size_t i = 0; i < strands.points.size(); ++i)
    if (!is_finite(strands.points[i])) return fmt::format("points: number {} is not finite", i);
  if (strands.has_width_per_point() && strands.widths.size() != strands.points.size())
    return fmt::format("widths: there are {} for {} control points", strands.widths.size(),
                       strands.points.size());
  for (std::size_t i = 0; i < strands.widths.size(); ++i)
    if (!(strands.widths[i] >= 0 && std::isfinite(strands.widths[i])))
      return fmt::format("widths: number {} is not 0 or above", i);
  return {};
}

Bounds3 strand_bounds(const Strands& strands, float thickness) {
  Bounds3 box;
  for (const vec3 p : strands.points) box.grow(p);
  if (box.empty()) return box;
  const float radius = 0.5f * thickness * *std::ranges::max_element(strands.widths);
  return {box.lo - radius, box.hi + radius};
}

std::shared_ptr<const Strands> single_strand() {
  static const auto strand = [] {
    Strands s;
    s.basis = CurveBasis::bezier;
    s.points = {{0, 0, 0}, {0, 0, 0.25f}, {0, 0, 0.75f}, {0, 0, 1}};
    s.counts = {4};
    s.widths = {0.1f, 0};
    return std::make_shared<const Strands>(std::move(s));
  }();
  return strand;
}

} // namespace candela
