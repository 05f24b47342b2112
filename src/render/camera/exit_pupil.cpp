#include "render/camera/exit_pupil.h"

#include <optional>
#include <vector>

namespace candela {

namespace {

constexpr int kColumns = 32;     ///< where a row is looked at first
constexpr int kCoarseRows = 12;  ///< to see how high the pupil is
constexpr int kRows = 16;        ///< of its outline
constexpr int kHalvings = 6;     ///< of an interval that holds a point of the outline
constexpr int kGrowths = 5;      ///< of the part of the plane that is searched
constexpr float kMargin = 1.02f; ///< of the semi-axes, for what lies between rows, columns and radii

struct Extent {
  float low, high;
  float middle() const { return 0.5f * (low + high); }
};

/// The upper half of a pupil: its extent in x at heights y.
struct Row {
  float y;
  Extent x;
};
using Outline = std::vector<Row>;

class PupilSearch {
public:
  PupilSearch(std::span<const LensSurface<float>> surfaces, const PupilQuery& query)
      : surfaces_(surfaces), query_(query) {}

  /// Mirror symmetry about the x axis halves the search.
  Outline outline(float film_x) const {
    const Extent all = rear_opening(film_x);
    const float height = rear_height();
    float radius = 0;
    Extent x = all;
    float top = height;
    if (const auto chief = chief_ray(film_x, radius); chief && radius > 0) {
      x = {std::max(*chief - 2 * radius, all.low), std::min(*chief + 2 * radius, all.high)};
      top = std::min(2 * radius, height);
      if (!(x.low < x.high)) x = all, top = height;
    }
    for (int i = 0;; ++i) {
      Extent found{kInfinity, -kInfinity};
      int rows = 0;
      for (int j = 0; j <= kCoarseRows; ++j)
        if (const auto e = extent(film_x, row_height(top, j, kCoarseRows), x)) {
          found = {std::min(found.low, e->low), std::max(found.high, e->high)};
          rows = j + 1;
        }
      const float column = (x.high - x.low) / kColumns;
      const bool cut_left = found.low < x.low + column && x.low > all.low;
      const bool cut_right = found.high > x.high - column && x.high < all.high;
      const bool cut_top = rows > kCoarseRows && top < height;
      if (i < kGrowths && (rows == 0 || cut_left || cut_right || cut_top)) { // maybe there is more
        const float grow = 0.5f * (x.high - x.low);
        x = {std::max(x.low - grow, all.low), std::min(x.high + grow, all.high)};
        top = std::min(1.6f * top, height);
        if (i + 1 == kGrowths) x = all, top = height;
        continue;
      }
      if (rows == 0) return {};
      found = {std::max(found.low - column, all.low), std::min(found.high + column, all.high)};
      return rows_up_to(top_of(film_x, top, rows, found), film_x, found);
    }
  }

private:
  static float row_height(float top, int j, int rows) {
    return top * static_cast<float>(j) / static_cast<float>(rows);
  }

  bool passes(float film_x, vec2 at, bool clip = true, float* stop_x = nullptr) const {
    vec3 p(film_x, 0, -query_.film_distance);
    vec3 d = glm::normalize(vec3(at, 0) - p);
    for (const LensSurface<float>& s : surfaces_) {
      if (!cross_lens_surface<true>(s, p, d, clip)) return false;
      if (s.stop && stop_x != nullptr) {
        *stop_x = p.x;
        return true;
      }
    }
    return true;
  }

  /// Distances from the film to the last surface, at its vertex and at its rim.
  std::array<float, 2> rear_distances() const {
    const LensSurface<float>& s = surfaces_.front();
    const float k = s.curvature, sine = std::min(std::abs(k) * s.radius, 1.0f);
    const float sag = k == 0 ? 0 : (1 - std::sqrt(1 - sqr(sine))) / k;
    return {query_.film_distance, std::max(query_.film_distance + sag, 1e-3f * query_.film_distance)};
  }
  /// What of the plane leads to the opening of the last interface.
  Extent rear_opening(float film_x) const {
    Extent e{kInfinity, -kInfinity};
    const float a = surfaces_.front().radius;
    for (float distance : rear_distances())
      for (float x : {-a, a}) {
        const float at = film_x + (x - film_x) * query_.film_distance / distance;
        e = {std::min(e.low, at), std::max(e.high, at)};
      }
    return e;
  }
  float rear_height() const {
    const auto [vertex, rim] = rear_distances();
    return surfaces_.front().radius * query_.film_distance / std::min(vertex, rim);
  }

  /// Where a ray crosses the plane that goes through the middle of the stop (openings aside), and how large
  /// the stop looks there.
  std::optional<float> chief_ray(float film_x, float& radius) const {
    const float scale = query_.film_distance / (query_.film_distance + query_.pupil_z);
    if (!std::isfinite(scale)) return std::nullopt;
    const float step = 1e-3f * rear_height();
    float stop_radius = 0;
    for (const LensSurface<float>& s : surfaces_)
      if (s.stop) stop_radius = s.radius;
    float x = film_x * (1 - scale);
    for (int i = 0; i < 12; ++i) { // Newton's method
      float at = 0, beside = 0;
      if (!passes(film_x, {x, 0}, false, &at) || !passes(film_x, {x + step, 0}, false, &beside))
        return std::nullopt;
      const float slope = (beside - at) / step;
      if (slope == 0) return std::nullopt;
      radius = stop_radius / std::abs(slope);
      if (std::abs(at) < 0.02f * stop_radius) return x;
      x -= at / slope;
    }
    return std::nullopt;
  }

  /// What of a row passes, to within a small part of a column.
  std::optional<Extent> extent(float film_x, float y, Extent x) const {
    const float column = (x.high - x.low) / kColumns;
    auto at = [&](int i) { return x.low + column * static_cast<float>(i); };
    int first = 0, last = kColumns;
    while (first <= kColumns && !passes(film_x, {at(first), y})) ++first;
    if (first > kColumns) return std::nullopt;
    while (!passes(film_x, {at(last), y})) --last;
    auto refine = [&](float inside, float outside) {
      for (int i = 0; i < kHalvings; ++i) {
        const float middle = 0.5f * (inside + outside);
        (passes(film_x, {middle, y}) ? inside : outside) = middle;
      }
      return outside;
    };
    return Extent{first == 0 ? at(0) : refine(at(first), at(first - 1)),
                  last == kColumns ? at(kColumns) : refine(at(last), at(last + 1))};
  }

  float top_of(float film_x, float top, int rows, Extent x) const {
    float inside = row_height(top, rows - 1, kCoarseRows);
    if (rows > kCoarseRows) return inside;
    float outside = row_height(top, rows, kCoarseRows);
    for (int i = 0; i < kHalvings; ++i) {
      const float middle = 0.5f * (inside + outside);
      (extent(film_x, middle, x) ? inside : outside) = middle;
    }
    return inside;
  }

  Outline rows_up_to(float top, float film_x, Extent x) const {
    Outline rows;
    for (int j = 0; j <= kRows; ++j) {
      const float y = row_height(top, j, kRows);
      if (const auto e = extent(film_x, y, x)) rows.push_back({y, *e});
    }
    return rows;
  }

  std::span<const LensSurface<float>> surfaces_;
  PupilQuery query_;
};

/// The smallest of many ellipses that hold the outline.
PupilEllipse ellipse_around(const Outline& outline) {
  if (outline.empty()) return {};
  Extent x{kInfinity, -kInfinity};
  float top = 0;
  for (const Row& row : outline) {
    x = {std::min(x.low, row.x.low), std::max(x.high, row.x.high)};
    top = std::max(top, row.y);
  }
  const float half = 0.5f * (x.high - x.low);
  if (!(half > 0) || !(top > 0)) return {x.middle(), vec2(std::max(half, top) + 1e-6f)};
  PupilEllipse best;
  float best_area = kInfinity;
  for (int i = -8; i <= 8; ++i) {
    const float center = x.middle() + 0.03f * static_cast<float>(i) * half;
    for (int j = -12; j <= 12; ++j) {
      const float ratio = top / half * std::exp2(static_cast<float>(j) / 12);
      float a2 = 0;
      for (const Row& row : outline)
        for (float edge : {row.x.low, row.x.high}) a2 = std::max(a2, sqr(edge - center) + sqr(row.y / ratio));
      if (a2 * ratio < best_area) {
        best_area = a2 * ratio;
        best = {center, vec2(1, ratio) * std::sqrt(a2)};
      }
    }
  }
  best.semi_axes *= kMargin;
  return best;
}

bool holds(const PupilEllipse& e, const Outline& outline) {
  for (const Row& row : outline)
    for (float edge : {row.x.low, row.x.high})
      if (sqr((edge - e.center) / e.semi_axes.x) + sqr(row.y / e.semi_axes.y) > 1) return false;
  return true;
}

} // namespace

ExitPupils::ExitPupils(std::span<const LensSurface<float>> surfaces, const PupilQuery& query)
    : per_radius_(kIntervals / query.film_radius) {
  const PupilSearch search(surfaces, query);
  const float step = query.film_radius / kIntervals;
  Outline begin = search.outline(0);
  for (int i = 0; i < kIntervals; ++i) {
    auto outline = [&](float f) { return search.outline(step * (static_cast<float>(i) + f)); };
    const Outline middle = outline(0.5f);
    Outline end = outline(1);
    Interval& interval = intervals_[static_cast<std::size_t>(i)];
    interval = {ellipse_around(begin), ellipse_around(end)};
    PupilEllipse between = interval.at(0.5f);
    between.semi_axes *= 0.5f * (1 + 1 / kMargin); // half of the margin is for what lies beside the middle
    const bool vanishes = begin.empty() || end.empty();
    if (vanishes || !holds(between, middle)) {
      // Another opening begins to cut the pupil: one ellipse for all of the interval.
      Outline all;
      for (const Outline& o : {begin, outline(0.25f), middle, outline(0.75f), end})
        all.insert(all.end(), o.begin(), o.end());
      if (vanishes) // what is left of it before it is gone may have moved on
        for (Row& row : all) row.x = {row.x.low - 0.25f * step, row.x.high + 0.25f * step};
      interval.begin = interval.end = ellipse_around(all);
    }
    begin = std::move(end);
  }
}

} // namespace candela
