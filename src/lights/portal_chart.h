#pragma once
// The light of the surroundings as it comes through openings of one orientation: a chart in which the part
// that is seen through any of them is a rectangle.

#include "core/progress.h"
#include "core/spectrum.h"

#include <functional>
#include <optional>
#include <vector>

namespace candela {

/// The directions of a portal's sides and of its outside. World space, unit, perpendicular to each other.
struct PortalAxes {
  vec3 x{1, 0, 0}, y{0, 1, 0};
  vec3 outwards{0, 0, -1}; ///< out of the room
  bool operator==(const PortalAxes&) const = default;
};

/// The luminance of an infinite light over the hemisphere that lies outwards. A direction (x, y, 1) along the
/// axes is at (t / (1 + |t|)), t being x and y, so that an upright rectangle of the portal's plane, seen from
/// anywhere, is one of the chart, and what it sends is one look into a summed-area table (Bitterli, Novak and
/// Jarosz 2015, "Portal-Masked Environment Map Sampling", whose chart are the angles atan t, which cost more;
/// pbrt-v4, sections 12.5.3 and A.5.5). Cells differ by a factor of two per angle, those near the corners by
/// more.
class PortalChart {
public:
  /// `radiance`: what arrives from a unit direction, W/(m^2 sr): finite. `side`: cells along
  /// each side; a cell is the mean of lookups^2 looks. Throws Cancelled soon after `progress` is told to end;
  /// it may be null.
  PortalChart(const PortalAxes& axes, int side, int lookups, const std::function<Spectrum(vec3)>& radiance,
              const Progress* progress = nullptr);

  const PortalAxes& axes() const { return axes_; }

  /// A rectangle of the chart, in cells, and what it sends.
  struct Window {
    glm::dvec2 lo, hi;
    double sum = 0; ///< luminance over its solid angle; 0 where it is too small, or dark
  };
  /// Of the directions (x, y, 1) between lo and hi.
  Window window(glm::dvec2 lo, glm::dvec2 hi) const;

  /// Where a direction is, and the luminance as sample() knows it: constant over a cell of the chart.
  struct Place {
    glm::dvec2 cell;
    double luminance;
  };
  /// A unit direction in the window, in proportion to the luminance of the cells, and its place; u in
  /// [0, 1)^2. The window has a sum.
  struct Sample {
    vec3 direction;
    Place place;
  };
  Sample sample(const Window& window, vec2 u) const;
  /// Nothing for directions that do not lead outwards.
  std::optional<Place> place(vec3 direction) const;
  static bool contains(const Window& w, const Place& at) {
    return at.cell.x >= w.lo.x && at.cell.x <= w.hi.x && at.cell.y >= w.lo.y && at.cell.y <= w.hi.y;
  }
  std::size_t memory_bytes() const { return cells_.size() * sizeof(float) + sums_.size() * sizeof(double); }

private:
  double cell_of_tangent(double t) const { return half_side_ * (t / (1 + std::abs(t)) + 1); }
  double tangent_of_cell(double cell) const;
  double steradians(double tx, double ty) const;
  Place place_at(double tx, double ty) const;
  int index(double cell) const { return std::clamp(static_cast<int>(cell), 0, side_ - 1); }
  vec3 direction(double tx, double ty) const {
    return glm::normalize(static_cast<float>(tx) * axes_.x + static_cast<float>(ty) * axes_.y +
                          axes_.outwards);
  }
  const double* row_of_sums(int y) const { return &sums_[static_cast<std::size_t>(y * (side_ + 1))]; }

  PortalAxes axes_;
  int side_;
  double half_side_;
  std::vector<float> cells_; ///< luminance over the solid angle of each, row by row
  std::vector<double> sums_; ///< of all cells before each corner of the grid
};

} // namespace candela
