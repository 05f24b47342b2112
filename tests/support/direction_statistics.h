#pragma once
// Chi-square test of sampled directions against a density over the sphere, and quadrature over the sphere.

#include "core/math.h"
#include "support/statistics.h"

#include <functional>
#include <optional>
#include <vector>

namespace candela::test {

/// Bins of the unit sphere: rings about +z times sectors of azimuth, crowded around `peak` so that they fit a
/// lobe of angular `width` (radians) there; both angles are spaced by a Cauchy distribution, so the tails
/// have bins, too. The horizon z = 0 is an edge of bins; three in four rings are on peak's side of it.
class SphereBins {
public:
  explicit SphereBins(vec3 peak = {0, 0, 1}, double width = 2, int rings = 20, int sectors = 32);

  std::size_t size() const { return static_cast<std::size_t>(rings_ * sectors_); }
  std::size_t index(vec3 w) const;
  /// Integrals of a function of unit directions over each bin, sr: adaptive Gauss-Legendre with an absolute
  /// error of about `tolerance` per bin (discontinuities are resolved by subdivision).
  std::vector<double> integrate(const std::function<double(vec3)>& f, double tolerance = 3e-6) const;

private:
  /// x in [lo, hi], spaced as the quantiles of a Cauchy distribution about m that is cut off there.
  class Spacing {
  public:
    Spacing(double lo, double hi, double m, double width);
    double quantile(double s) const;
    double density(double x) const; ///< ds / dx
    double cdf(double x) const;

  private:
    double lo_, hi_, m_, width_, angle_lo_, angle_range_;
  };
  struct Cell {
    const Spacing* theta;
    double s0, s1, t0, t1; ///< quantiles of theta and of phi
  };
  double gauss(const std::function<double(vec3)>& f, const Cell& cell) const;
  double integrate_cell(const std::function<double(vec3)>& f, const Cell& cell, double tolerance,
                        int depth) const;

  double side_; ///< of peak: +1 above the horizon, -1 below; theta counts from side_ * z
  double peak_theta_, peak_azimuth_;
  int rings_, sectors_, rings_on_side_;
  Spacing theta_on_side_, theta_beyond_, phi_; ///< phi counts from peak's azimuth
};

/// The integral of f over the sphere, sr; peak and width (as of SphereBins) locate its main part.
double integrate_sphere(const std::function<double(vec3)>& f, vec3 peak = {0, 0, 1}, double width = 2);

struct DirectionTest {
  ChiSquareResult chi_square;
  double pdf_integral = 0; ///< the expected share of successful draws
};

/// `draw(i)` gives the i-th of `count` independent directions, or nothing if sampling fails (counted in a bin
/// of its own); `pdf` is its density in 1/sr, with an integral of at most 1. A draw with pdf 0 gives p = 0.
DirectionTest test_directions(const SphereBins& bins, std::size_t count,
                              const std::function<std::optional<vec3>(std::size_t)>& draw,
                              const std::function<double(vec3)>& pdf);

} // namespace candela::test
