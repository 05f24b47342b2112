#include "lights/portal_guide.h"

#include "core/color.h"

#include <numbers>

namespace candela {

namespace {

constexpr double kSides = PortalChart::kSide;

/// From the tangent of the angle with an axis to cells.
double cell_of_tangent(double tangent) { return kSides * (std::atan(tangent) / std::numbers::pi + 0.5); }
/// The tangent at a place, of which none is a right angle's.
double tangent_of_cell(double cell) {
  const double angle = std::numbers::pi * (cell / kSides - 0.5);
  return std::tan(std::clamp(angle, -1.5707963, 1.5707963));
}

/// Solid angle over the area of a cell where x and y are the tangents of the angles: d(alpha) d(beta) is
/// (1 - wx^2) (1 - wy^2) / wz d(omega), w being the unit direction (x, y, 1).
double steradians(double x, double y) {
  const double r2 = 1 + x * x + y * y;
  constexpr double kCellAngle = std::numbers::pi / kSides;
  return kCellAngle * kCellAngle * (1 + x * x) * (1 + y * y) / (r2 * std::sqrt(r2));
}

int cell_index(double at) { return std::clamp(static_cast<int>(at), 0, PortalChart::kSide - 1); }

/// Where in [lo, hi] the increasing piecewise linear function F, whose corners are at the integers, takes the
/// value.
template <class F>
double invert(double value, double lo, double hi, F f) {
  int first = cell_index(std::floor(lo)), last = cell_index(std::ceil(hi) - 1);
  while (first < last) {
    const int middle = first + (last - first) / 2;
    if (f(static_cast<double>(middle + 1)) > value)
      last = middle;
    else
      first = middle + 1;
  }
  const double a = std::max(lo, static_cast<double>(first)), b = std::min(hi, static_cast<double>(first + 1));
  const double before = f(a), all = f(b) - before;
  return all > 0 ? std::clamp(a + (b - a) * (value - before) / all, a, b) : a;
}

} // namespace

PortalChart::PortalChart(const PortalRectangle& portal, const std::function<Spectrum(vec3)>& radiance,
                         const Progress* progress)
    : portal_(portal) {
  constexpr int kLookups = 2; // along each side of a cell
  cells_.reserve(static_cast<std::size_t>(kSide) * kSide);
  sums_.assign(static_cast<std::size_t>(kSide + 1) * (kSide + 1), 0.0);
  for (int y = 0; y < kSide; ++y) {
    if (progress != nullptr) progress->check();
    double row = 0;
    for (int x = 0; x < kSide; ++x) {
      double sum = 0;
      for (int i = 0; i < kLookups * kLookups; ++i) {
        const double at_x = x + (i % kLookups + 0.5) / kLookups, at_y = y + (i / kLookups + 0.5) / kLookups;
        const double tx = tangent_of_cell(at_x), ty = tangent_of_cell(at_y);
        const vec3 d = glm::normalize(static_cast<float>(tx) * portal_.axis_x +
                                      static_cast<float>(ty) * portal_.axis_y + portal_.outwards);
        sum += static_cast<double>(luminance(radiance(d))) * steradians(tx, ty);
      }
      cells_.push_back(static_cast<float>(sum));
      row += cell(x, y);
      sums_[static_cast<std::size_t>((y + 1) * (kSide + 1) + x + 1)] = row + corner_sum(x + 1, y);
    }
  }
}

/// Between the corners bilinear, which is exact, for the function is constant in each cell.
double PortalChart::sum_to(double x, double y) const {
  const int ix = cell_index(x), iy = cell_index(y);
  const double fx = x - ix, fy = y - iy;
  return (1 - fy) * ((1 - fx) * corner_sum(ix, iy) + fx * corner_sum(ix + 1, iy)) +
         fy * ((1 - fx) * corner_sum(ix, iy + 1) + fx * corner_sum(ix + 1, iy + 1));
}

double PortalChart::sum_of(glm::dvec2 lo, glm::dvec2 hi) const {
  return std::max(sum_to(hi.x, hi.y) - sum_to(lo.x, hi.y) - sum_to(hi.x, lo.y) + sum_to(lo.x, lo.y), 0.0);
}

PortalChart::Window PortalChart::seen_from(vec3 position) const {
  Window w;
  const glm::dvec3 d = glm::dvec3(portal_.center) - glm::dvec3(position);
  const double distance = glm::dot(d, glm::dvec3(portal_.outwards));
  if (!(distance > 0)) return w;
  const glm::dvec2 middle(glm::dot(d, glm::dvec3(portal_.axis_x)), glm::dot(d, glm::dvec3(portal_.axis_y)));
  const glm::dvec2 half(portal_.half_size);
  for (int axis = 0; axis < 2; ++axis) {
    w.lo[axis] = cell_of_tangent((middle[axis] - half[axis]) / distance);
    w.hi[axis] = cell_of_tangent((middle[axis] + half[axis]) / distance);
  }
  w.sum = sum_of(w.lo, w.hi);
  // Of differences of sums, little more than rounding is left.
  if (!(w.sum > 1e-12 * corner_sum(kSide, kSide))) w.sum = 0;
  return w;
}

vec3 PortalChart::sample(const Window& w, vec2 u) const {
  const double x = invert(static_cast<double>(u.x) * w.sum, w.lo.x, w.hi.x, [&](double at) {
    return sum_of(w.lo, {at, w.hi.y});
  });
  // Then within the column of cells that x is in.
  const int column = cell_index(x);
  auto column_sum = [&](double to) {
    return sum_of({static_cast<double>(column), w.lo.y}, {static_cast<double>(column + 1), to});
  };
  const double y = invert(static_cast<double>(u.y) * column_sum(w.hi.y), w.lo.y, w.hi.y, column_sum);
  // Not so near to the border that rounding leads across it.
  const glm::dvec2 border = glm::min(glm::dvec2(1e-4), 0.25 * (w.hi - w.lo));
  const glm::dvec2 at = glm::clamp(glm::dvec2(x, y), w.lo + border, w.hi - border);
  return glm::normalize(static_cast<float>(tangent_of_cell(at.x)) * portal_.axis_x +
                        static_cast<float>(tangent_of_cell(at.y)) * portal_.axis_y + portal_.outwards);
}

double PortalChart::luminance_at(const Window& w, vec3 direction) const {
  const glm::dvec3 d(direction);
  const double z = glm::dot(d, glm::dvec3(portal_.outwards));
  if (!(z > 0)) return 0;
  const double tx = glm::dot(d, glm::dvec3(portal_.axis_x)) / z,
               ty = glm::dot(d, glm::dvec3(portal_.axis_y)) / z;
  const double x = cell_of_tangent(tx), y = cell_of_tangent(ty);
  if (!(x >= w.lo.x && x <= w.hi.x && y >= w.lo.y && y <= w.hi.y)) return 0;
  return cell(cell_index(x), cell_index(y)) / steradians(tx, ty);
}

PortalGuide::PortalGuide(std::span<const PortalRectangle> portals,
                         const std::function<Spectrum(vec3)>& radiance, const Progress* progress) {
  for (const PortalRectangle& portal : portals) charts_.emplace_back(portal, radiance, progress);
}

PortalGuide::View PortalGuide::seen_from(vec3 position) const {
  View view;
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    view.windows[i] = charts_[i].seen_from(position);
    view.sum += view.windows[i].sum;
  }
  return view;
}

vec3 PortalGuide::sample(const View& view, vec2 u) const {
  double left = static_cast<double>(u.x) * view.sum;
  std::size_t chosen = 0;
  while (chosen + 1 < charts_.size() && !(left < view.windows[chosen].sum))
    left -= view.windows[chosen++].sum;
  while (!(view.windows[chosen].sum > 0)) --chosen; // rounding led behind the last one
  const double share = std::min(left / view.windows[chosen].sum, static_cast<double>(kOneMinusEpsilon));
  return charts_[chosen].sample(view.windows[chosen], {static_cast<float>(share), u.y});
}

float PortalGuide::pdf(const View& view, vec3 direction) const {
  double sum = 0;
  for (std::size_t i = 0; i < charts_.size(); ++i)
    if (view.windows[i].sum > 0) sum += charts_[i].luminance_at(view.windows[i], direction);
  return static_cast<float>(sum / view.sum);
}

std::size_t PortalGuide::memory_bytes() const {
  std::size_t bytes = 0;
  for (const PortalChart& chart : charts_) bytes += chart.memory_bytes();
  return bytes;
}

} // namespace candela
