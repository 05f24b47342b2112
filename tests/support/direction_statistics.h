#pragma once
// Chi-square test of sampled directions against a density over the sphere, and quadrature over the sphere.

#include "core/math.h"
#include "support/statistics.h"

#include <functional>
#include <optional>
#include <vector>

namespace candela::test {

/// Bins of the unit sphere: rings about an axis times equal sectors. Rings are equal in s, with tan(theta /
/// 2) = width sqrt(s / (1 - s)): half of them lie within tan(theta / 2) < width / sqrt 2 of the axis, so that
/// the width of a narrow lobe fits the bins and quadrature to it. width = 1 makes all bins of equal solid
/// angle.
class SphereBins {
public:
  SphereBins(vec3 axis, double width, int rings = 16, int sectors = 32);

  std::size_t size() const { return static_cast<std::size_t>(rings_ * sectors_); }
  std::size_t index(vec3 w) const;
  /// Of a function of unit directions over each bin, sr: adaptive Gauss-Legendre, absolute error of a bin
  /// some `tolerance` (edges of the function within a bin are found by subdivision).
  std::vector<double> integrate(const std::function<double(vec3)>& f, double tolerance = 1e-6) const;

private:
  double integrate_cell(const std::function<double(vec3)>& f, double s0, double s1, double phi0, double phi1,
                        double tolerance, int depth) const;
  double gauss(const std::function<double(vec3)>& f, double s0, double s1, double phi0, double phi1) const;

  glm::dvec3 x_, y_, z_;
  double width_;
  int rings_, sectors_;
};

/// Of f over the whole sphere, sr; axis and width say where most of it is.
double integrate_sphere(const std::function<double(vec3)>& f, vec3 axis = {0, 0, 1}, double width = 1);

struct DirectionTest {
  ChiSquareResult chi_square;
  double pdf_integral = 0; ///< the share of draws that should have succeeded
};

/// `draw(i)` gives the i-th of `count` independent directions, or nothing where sampling fails (a bin of its
/// own); `pdf` is its density in 1/sr, integrating to at most 1.
DirectionTest test_directions(const SphereBins& bins, std::size_t count,
                              const std::function<std::optional<vec3>(std::size_t)>& draw,
                              const std::function<double(vec3)>& pdf);

} // namespace candela::test
