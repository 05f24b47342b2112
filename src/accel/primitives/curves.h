#pragma once
// Strands of hair: cubic Bezier curves with a radius at each control point, as round tubes or as flat ribbons
// that face the ray.
//
// A tube is the envelope of balls along the curve. Only its outside is hit, as in Embree and Mitsuba: a ray
// that begins inside leaves it unhindered. A ribbon faces each ray wherever it meets it; a ray that begins
// within the tube about it does not hit it there, so that a ray never hits the spot that it leaves.

#include "accel/primitives/pack.h"
#include "core/basis.h"

#include <optional>

namespace candela {

/// A piece of a strand. World space; pieces of a strand share their end points, bit for bit.
struct CurveSegment {
  /// What the ends of the piece are, and its form.
  enum Flags : std::uint32_t {
    tube = 0,
    ribbon = 1,
    /// A ball closes the tube, or a disc that faces the ray the ribbon: at the ends of tubes and where
    /// strands have a corner. Elsewhere the next piece continues in the same direction.
    closed_start = 2,
    closed_end = 4,
    /// Neither continued nor closed: the ends of ribbons.
    cut_start = 8,
    cut_end = 16,
  };
  std::array<vec4, 4> points{}; ///< control points, and their radii in w
  std::uint32_t flags = tube;
};

struct alignas(32) CurvePack {
  std::array<std::array<std::array<float, kWidth>, 4>, 4> point; ///< [k][x, y, z, radius]
  std::array<std::uint32_t, kWidth> primitive, flags;

  static CurvePack unused() {
    constexpr std::array<float, kWidth> kNone{};
    constexpr std::array<std::array<float, kWidth>, 4> kPoint{kNowhere, kNowhere, kNowhere, kNone};
    return {{kPoint, kPoint, kPoint, kPoint}, {}, {}};
  }
  bool operator==(const CurvePack&) const = default;
};

namespace accel_detail {

/// A ray as curves are tested with it, in double precision: its length along a unit direction, and two axes
/// across.
struct CurveRay {
  glm::dvec3 origin, along, across_x, across_y;
  double length; ///< of the ray's direction
  float t_min, t_max;

  CurveRay(const Ray& ray, float least, float greatest);
};

struct CurveHit {
  float t;
  float u; ///< of the segment, 0 to 1; beyond by kCurveOverlap at most, where it continues
};

/// Pieces that continue beyond an end are tested that much farther, so that what rounds differently in both
/// leaves no gap between them.
inline constexpr double kCurveOverlap = 0x1p-10;

/// The closest hit with t in (t_min, t_max).
std::optional<CurveHit> intersect_curve(const CurveSegment& segment, const CurveRay& ray);

} // namespace accel_detail

namespace primitives {

struct Curves {
  struct Input {
    std::span<const CurveSegment> curves = {};
  };
  using Pack = CurvePack;
  static constexpr std::uint32_t kLeafCapacity = kWidth;
  static constexpr float kLeafCost = 2;

  static std::size_t count(const Input& input) { return input.curves.size(); }

  static Bounds3 bounds(const Input& input, std::size_t i) {
    const auto& p = input.curves[i].points;
    Bounds3 hull;
    float radius = 0;
    for (const vec4& point : p) {
      if (!accel_detail::usable(vec3(point)) || !(std::abs(point.w) <= kMaxCoordinate)) return {};
      hull.grow(vec3(point));
      radius = std::max(radius, point.w);
    }
    if (!(radius > 0)) return {};
    // What continues beyond the ends: the tangents there, by the overlap, and half as much again.
    const vec3 beyond =
        glm::max(glm::abs(vec3(p[1] - p[0])), glm::abs(vec3(p[3] - p[2]))) * (4.5f * kOverlap);
    return accel_detail::padded(hull.center(),
                                0.5f * hull.diagonal() + beyond + radius * (1 + 4.5f * kOverlap));
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    accel_detail::fill_lanes(pack, primitives, [&](std::size_t lane, std::uint32_t i) {
      const CurveSegment& curve = input.curves[i];
      for (std::size_t k = 0; k < 4; ++k)
        for (int axis = 0; axis < 4; ++axis)
          pack.point[k][static_cast<std::size_t>(axis)][lane] = curve.points[k][axis];
      pack.flags[lane] = curve.flags;
    });
  }

  /// The closest lane, and those at the same t. The lanes whose control polygon comes near the ray are tested
  /// one by one, in double precision; those that begin behind the closest hit so far are not.
  template <class F>
  static void intersect(const Pack& pack, const Ray& ray, float t_min, float t_max,
                        accel_detail::LaneHits& hits) {
    NearLanes near = near_lanes<F>(pack, ray, t_min, t_max);
    hits.lanes = 0;
    if (!near.lanes) return;
    accel_detail::CurveRay curve_ray(ray, t_min, t_max);
    do {
      const std::size_t lane = near.take_first();
      if (near.begin[lane] > curve_ray.t_max) return;
      const auto hit = accel_detail::intersect_curve(segment(pack, lane), curve_ray);
      if (!hit) continue;
      hits.t[lane] = hit->t, hits.u[lane] = hit->u;
      hits.lanes |= 1u << lane;
      curve_ray.t_max = std::nextafter(hit->t, kInfinity);
    } while (near.lanes);
  }

  template <class F>
  static bool occluded(const Pack& pack, const Ray& ray, float t_min, float t_max) {
    NearLanes near = near_lanes<F>(pack, ray, t_min, t_max);
    if (!near.lanes) return false;
    const accel_detail::CurveRay curve_ray(ray, t_min, t_max);
    do
      if (accel_detail::intersect_curve(segment(pack, near.take_first()), curve_ray)) return true;
    while (near.lanes);
    return false;
  }

  /// CurveHit::u, and 0.
  static vec2 parameters(const Pack&, std::size_t lane, const Ray&, const accel_detail::LaneHits& hits) {
    return {hits.u[lane], 0};
  }

private:
  static constexpr auto kOverlap = static_cast<float>(accel_detail::kCurveOverlap);

  static CurveSegment segment(const Pack& pack, std::size_t lane) {
    CurveSegment curve;
    for (std::size_t k = 0; k < 4; ++k)
      for (int axis = 0; axis < 4; ++axis)
        curve.points[k][axis] = pack.point[k][static_cast<std::size_t>(axis)][lane];
    curve.flags = pack.flags[lane];
    return curve;
  }

  struct NearLanes {
    simd::LaneMask lanes = 0;
    alignas(32) std::array<float, kWidth> begin; ///< t before which the ray does not hit the lane

    std::size_t take_first() {
      auto first = static_cast<std::size_t>(std::countr_zero(lanes));
      simd::for_each_lane(lanes & (lanes - 1), [&](int i) {
        if (const auto lane = static_cast<std::size_t>(i); begin[lane] < begin[first]) first = lane;
      });
      lanes &= ~(1u << first);
      return first;
    }
  };

  /// Seen along the ray, the curve lies within the hull of its control points, grown by the greatest radius:
  /// lanes where that misses the ray along either axis across it, or across the line between the ends, or
  /// lies beyond t_min or t_max, are out. Unused lanes are NaN or infinite, and out.
  template <class F>
  static NearLanes near_lanes(const Pack& pack, const Ray& ray, float t_min, float t_max) {
    const float length = glm::length(ray.direction);
    const vec3 along = ray.direction / length;
    const Basis across = Basis::from_normal(along);
    const vec3 axis_x = across.s, axis_y = across.t;
    std::array<F, 4> x, y, z;
    F radius(0.0f), reach(0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<F, 3> p;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = F::load(pack.point[k][i].data()) - F(ray.origin[static_cast<int>(i)]);
        reach = max(max(p[i], F(0.0f) - p[i]), reach);
      }
      x[k] = p[0] * F(axis_x.x) + p[1] * F(axis_x.y) + p[2] * F(axis_x.z);
      y[k] = p[0] * F(axis_y.x) + p[1] * F(axis_y.y) + p[2] * F(axis_y.z);
      z[k] = p[0] * F(along.x) + p[1] * F(along.y) + p[2] * F(along.z);
      radius = max(F::load(pack.point[k][3].data()), radius);
    }
    // The axes are off by some eps, the sums by some eps of what is summed (eps = 2^-24); what lies beyond
    // the ends is within 3 kCurveOverlap of what they span.
    const F rounding = reach * F(0x1p-19f), thick = radius * F(1 + 8 * kOverlap) + rounding;
    auto least = [](const std::array<F, 4>& at) { return min(min(at[0], at[1]), min(at[2], at[3])); };
    auto greatest = [](const std::array<F, 4>& at) { return max(max(at[0], at[1]), max(at[2], at[3])); };
    auto meets = [&](const std::array<F, 4>& at, F limit) {
      const F lo = least(at), hi = greatest(at);
      limit = limit + (hi - lo) * F(8 * kOverlap);
      return less_equal(lo, limit) & less_equal(F(0.0f) - limit, hi);
    };
    NearLanes near;
    near.lanes = meets(x, thick) & meets(y, thick);
    if (!near.lanes) return near;
    const F first = least(z), last = greatest(z), beyond = thick + (last - first) * F(8 * kOverlap);
    const F begin = (first - beyond) * F((1 - 0x1p-20f) / length),
            end = (last + beyond) * F((1 + 0x1p-20f) / length);
    near.lanes &= less_equal(begin, F(t_max)) & less_equal(F(t_min), end);
    if (!near.lanes) return near;
    const F nx = y[0] - y[3], ny = x[3] - x[0];
    std::array<F, 4> off;
    for (std::size_t k = 0; k < 4; ++k) off[k] = x[k] * nx + y[k] * ny;
    near.lanes &= meets(off, (thick + rounding) * sqrt(nx * nx + ny * ny) * F(1 + 0x1p-20f));
    begin.store(near.begin.data());
    return near;
  }
};

} // namespace primitives

} // namespace candela
