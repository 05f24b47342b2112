#include "lights/portal_chart.h"

#include "core/color.h"

namespace candela {

namespace {

/// The first i in [first, end] with f(i + 1) > value, or `end`: from a guess by doubling steps, then by
/// halves.
template <class F>
int piece_with(double value, int first, int end, int guess, F f) {
  int step = 1;
  if (guess == end || f(guess + 1) > value) {
    int below = guess - 1;
    end = guess;
    while (below >= first && f(below + 1) > value) end = below, below -= step, step *= 2;
    first = std::max(first, below + 1);
  } else {
    int above = guess + 1;
    first = above;
    while (above < end && !(f(above + 1) > value)) first = above + 1, above += step, step *= 2;
    end = std::min(end, above);
  }
  while (first < end) {
    const int middle = first + (end - first) / 2;
    if (f(middle + 1) > value)
      end = middle;
    else
      first = middle + 1;
  }
  return end;
}

/// Where in [lo, hi] an increasing function has covered this share of its way. It is linear between integers,
/// where f(i) gives its values; `last` is the last integer at which a piece begins. The search begins where
/// the place would be if it were linear throughout: surroundings are smooth, but for a few lamps.
template <class F>
double invert(double share, double lo, double hi, int last, F f) {
  auto piece = [&](double at) { return std::clamp(static_cast<int>(at), 0, last); };
  const int first = piece(lo), end = piece(hi);
  auto between = [&](double at, int i) {
    const double from = f(i);
    return from + (at - i) * (f(i + 1) - from);
  };
  const double from = between(lo, first), value = from + share * (between(hi, end) - from);
  const int i = piece_with(value, first, end, piece(lo + share * (hi - lo)), f);
  const double before = f(i), slope = f(i + 1) - before;
  const double at = slope > 0 ? i + (value - before) / slope : lo;
  return std::clamp(at, std::max(lo, static_cast<double>(i)), std::min(hi, i + 1.0));
}

} // namespace

PortalChart::PortalChart(const PortalAxes& axes, int side, int lookups,
                         const std::function<Spectrum(vec3)>& radiance, const Progress* progress)
    : axes_(axes), side_(side), half_side_(0.5 * side) {
  cells_.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  sums_.assign(static_cast<std::size_t>(side + 1) * static_cast<std::size_t>(side + 1), 0.0);
  const double step = 1.0 / lookups, share = step * step;
  for (int y = 0; y < side; ++y) {
    if (progress != nullptr) progress->check();
    double* const sums = &sums_[static_cast<std::size_t>((y + 1) * (side + 1))];
    const double* const above = sums - (side + 1);
    double row = 0;
    for (int x = 0; x < side; ++x) {
      double sum = 0;
      for (int j = 0; j < lookups; ++j)
        for (int i = 0; i < lookups; ++i) {
          const double tx = tangent_of_cell(x + (i + 0.5) * step), ty = tangent_of_cell(y + (j + 0.5) * step);
          const float there = std::max(luminance(radiance(direction(tx, ty))), 0.0f);
          sum += static_cast<double>(there) * steradians(tx, ty);
        }
      cells_.push_back(static_cast<float>(sum * share));
      row += static_cast<double>(cells_.back());
      sums[x + 1] = above[x + 1] + row;
    }
  }
}

double PortalChart::tangent_of_cell(double cell) const {
  const double at = cell / half_side_ - 1;
  return at / std::max(1 - std::abs(at), 1e-9);
}

/// Solid angle over the area of a cell. Of the plane at distance 1, r^-3 dx dy is solid angle; and the
/// derivative of t / (1 + |t|) is (1 + |t|)^-2.
double PortalChart::steradians(double tx, double ty) const {
  const double r2 = 1 + tx * tx + ty * ty, across = (1 + std::abs(tx)) * (1 + std::abs(ty)) / half_side_;
  return across * across / (r2 * std::sqrt(r2));
}

PortalChart::Window PortalChart::window(glm::dvec2 lo, glm::dvec2 hi) const {
  Window w;
  for (int axis = 0; axis < 2; ++axis)
    w.lo[axis] = cell_of_tangent(lo[axis]), w.hi[axis] = cell_of_tangent(hi[axis]);
  // Between the corners of the grid sums are bilinear, which is exact: cells are constant.
  auto sum_to = [&](double x, double y) {
    const int ix = index(x), iy = index(y);
    const double fx = x - ix, fy = y - iy;
    const double* const upper = row_of_sums(iy) + ix;
    const double* const lower = upper + (side_ + 1);
    return (1 - fy) * ((1 - fx) * upper[0] + fx * upper[1]) + fy * ((1 - fx) * lower[0] + fx * lower[1]);
  };
  const double sum =
      sum_to(w.hi.x, w.hi.y) - sum_to(w.lo.x, w.hi.y) - sum_to(w.hi.x, w.lo.y) + sum_to(w.lo.x, w.lo.y);
  // Of much smaller differences of the sums little more than rounding is left.
  w.sum = sum > 1e-10 * sums_.back() ? sum : 0;
  return w;
}

PortalChart::Sample PortalChart::sample(const Window& w, vec2 u) const {
  // A column by its sum over the window's rows.
  const int top = index(w.lo.y), bottom = index(w.hi.y);
  const double f_top = w.lo.y - top, f_bottom = w.hi.y - bottom;
  const double *const t0 = row_of_sums(top), *const t1 = row_of_sums(top + 1);
  const double *const b0 = row_of_sums(bottom), *const b1 = row_of_sums(bottom + 1);
  const double x = invert(static_cast<double>(u.x), w.lo.x, w.hi.x, side_ - 1, [&](int i) {
    return (1 - f_bottom) * b0[i] + f_bottom * b1[i] - ((1 - f_top) * t0[i] + f_top * t1[i]);
  });
  // Then a place within that column of cells.
  const int column = index(x);
  const double y = invert(static_cast<double>(u.y), w.lo.y, w.hi.y, side_ - 1, [&](int i) {
    const double* const row = row_of_sums(i) + column;
    return row[1] - row[0];
  });
  // Not so near to the border that rounding leads across it.
  const glm::dvec2 border = glm::min(glm::dvec2(1e-4), 0.25 * (w.hi - w.lo));
  const glm::dvec2 at = glm::clamp(glm::dvec2(x, y), w.lo + border, w.hi - border);
  const double tx = tangent_of_cell(at.x), ty = tangent_of_cell(at.y);
  return {direction(tx, ty), place_at(tx, ty)};
}

PortalChart::Place PortalChart::place_at(double tx, double ty) const {
  const glm::dvec2 cell(cell_of_tangent(tx), cell_of_tangent(ty));
  const auto at = static_cast<std::size_t>(index(cell.y) * side_ + index(cell.x));
  return {cell, static_cast<double>(cells_[at]) / steradians(tx, ty)};
}

std::optional<PortalChart::Place> PortalChart::place(vec3 d) const {
  const auto z = static_cast<double>(glm::dot(d, axes_.outwards));
  if (!(z > 0)) return std::nullopt;
  return place_at(static_cast<double>(glm::dot(d, axes_.x)) / z,
                  static_cast<double>(glm::dot(d, axes_.y)) / z);
}

} // namespace candela
