#pragma once
// Counts of samples over a grid of cells, and those expected of a density.

#include "core/math.h"
#include "core/statistics.h"

#include <array>
#include <vector>

namespace candela {

/// A grid of columns x rows equal cells on the unit square of a chart's coordinates.
struct ChartGrid {
  int columns = 1, rows = 1;
  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  /// The cell of q in [0, 1]^2; points outside by rounding belong to the cell at the edge.
  std::size_t cell(vec2 q) const {
    auto index = [](float x, int n) {
      return static_cast<std::size_t>(std::clamp(static_cast<int>(x * static_cast<float>(n)), 0, n - 1));
    };
    return index(q.y, rows) * static_cast<std::size_t>(columns) + index(q.x, columns);
  }
};

/// Integral of f over [x0, x1] x [y0, y1] by Gauss-Legendre with four nodes a side.
template <class F>
double gauss_legendre(const F& f, double x0, double x1, double y0, double y1) {
  constexpr std::array<double, 4> kNodes = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                            0.8611363115940526};
  constexpr std::array<double, 4> kWeights = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                              0.3478548451374538};
  const double hx = 0.5 * (x1 - x0), hy = 0.5 * (y1 - y0), cx = 0.5 * (x0 + x1), cy = 0.5 * (y0 + y1);
  double sum = 0;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      sum += kWeights[i] * kWeights[j] *
             f(vec2(static_cast<float>(cx + hx * kNodes[i]), static_cast<float>(cy + hy * kNodes[j])));
  return sum * hx * hy;
}

/// The same by subdivision until a rectangle and its quarters agree within `tolerance`. The neighbourhood of
/// `focus` is always subdivided fully, since a narrow peak may lie between the nodes.
template <class F>
double integrate_adaptively(const F& f, double x0, double x1, double y0, double y1, vec2 focus,
                            double tolerance, int depth = 0) {
  constexpr int kMaxDepth = 9;
  const double xm = 0.5 * (x0 + x1), ym = 0.5 * (y0 + y1);
  const double whole = gauss_legendre(f, x0, x1, y0, y1);
  if (depth == kMaxDepth) return whole;
  const auto fx = static_cast<double>(focus.x), fy = static_cast<double>(focus.y);
  const bool near = fx >= x0 && fx <= x1 && fy >= y0 && fy <= y1;
  if (!near) {
    const double quarters = gauss_legendre(f, x0, xm, y0, ym) + gauss_legendre(f, xm, x1, y0, ym) +
                            gauss_legendre(f, x0, xm, ym, y1) + gauss_legendre(f, xm, x1, ym, y1);
    if (std::abs(whole - quarters) <= tolerance) return quarters;
  }
  auto quarter = [&](double a0, double a1, double b0, double b1) {
    return integrate_adaptively(f, a0, a1, b0, b1, focus, tolerance, depth + 1);
  };
  return quarter(x0, xm, y0, ym) + quarter(xm, x1, y0, ym) + quarter(x0, xm, ym, y1) +
         quarter(xm, x1, ym, y1);
}

/// Expected share of the draws in each cell: the integral of `density`, per unit area of the chart's square.
template <class F>
std::vector<double> expected_shares(ChartGrid grid, const F& density, vec2 focus = vec2(-1)) {
  constexpr double kTolerance = 1e-8; // per cell: far below the resolution of a billion draws
  std::vector<double> shares;
  shares.reserve(grid.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      shares.push_back(integrate_adaptively(
          density, static_cast<double>(column) / grid.columns, static_cast<double>(column + 1) / grid.columns,
          static_cast<double>(row) / grid.rows, static_cast<double>(row + 1) / grid.rows, focus, kTolerance));
  return shares;
}

/// Counts of draws by cell, and of those outside the grid.
struct Histogram {
  ChartGrid grid;
  std::vector<double> counts;   ///< by cell
  std::vector<double> expected; ///< share of the draws, by cell
  double outside = 0;           ///< draws that fell outside of the grid
  double outside_expected = 0;  ///< expected share of the draws outside
  double total = 0;             ///< draws

  double integral() const; ///< of `expected`: 1 for a normalised density
  /// Pearson's test of the counts against total * expected. Meant for independent draws: stratified ones are
  /// more even, with a p-value near 1.
  ChiSquareResult chi_square() const;
};

} // namespace candela
