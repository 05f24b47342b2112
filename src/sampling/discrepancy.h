#pragma once
// A measure of how evenly points fill the unit square.

#include "core/math.h"

#include <span>

namespace candela {

/// L2-star discrepancy of points in [0, 1)^2: the root mean square, over all boxes [0, a) x [0, b), of the
/// share of points in a box less its area. By Warnock's formula (Warnock 1972, "Computational Investigations
/// of Low-Discrepancy Point Sets"),
///     D^2 = 1/9 - 1/(2 n) sum_i (1 - x_i^2) (1 - y_i^2)
///           + 1/n^2 sum_ij (1 - max(x_i, x_j)) (1 - max(y_i, y_j)),
/// in a time of n^2. Independent uniform points have a mean D^2 of 5 / (36 n). No points: 1/3, the boxes'
/// root mean square area.
inline double l2_star_discrepancy(std::span<const vec2> points) {
  double n = static_cast<double>(points.size());
  if (points.empty()) return 1.0 / 3;
  double single = 0, pairs = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double x = static_cast<double>(points[i].x), y = static_cast<double>(points[i].y);
    single += (1 - x * x) * (1 - y * y);
    pairs += (1 - x) * (1 - y);
    for (std::size_t j = 0; j < i; ++j)
      pairs += 2 * (1 - std::max(x, static_cast<double>(points[j].x))) *
               (1 - std::max(y, static_cast<double>(points[j].y)));
  }
  return std::sqrt(std::max(1.0 / 9 - single / (2 * n) + pairs / (n * n), 0.0));
}

} // namespace candela
