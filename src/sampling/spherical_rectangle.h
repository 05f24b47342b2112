#pragma once
// Sampling of the solid angle of a rectangle or triangle as seen from a point.

#include "core/math.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace candela {

/// Solid angle in sr, in [0, 2 pi], of the spherical triangle between unit vectors (Van Oosterom & Strackee
/// 1983, "The Solid Angle of a Plane Triangle"). Only vertices' directions enter, so a small and far triangle
/// loses digits to the triple product; for those area / distance^2 is as good.
inline float spherical_triangle_solid_angle(vec3 a, vec3 b, vec3 c) {
  float numerator = std::abs(glm::dot(a, glm::cross(b - a, c - a)));
  float denominator = 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
  return std::abs(2 * std::atan2(numerator, denominator));
}

namespace detail {

struct CosSin {
  double cos, sin;
};
/// Of an angle in [0, 2 pi], error below 3e-16: minimax polynomials of quarter turns, for the same bits on
/// every machine and at half the cost of libm's. Without branches, for loops that are vectorised.
inline CosSin cos_sin(double angle) {
  double quarters = angle * (2 * std::numbers::inv_pi);
  double nearest = static_cast<int>(quarters + 0.5);
  double r = quarters - nearest, r2 = r * r;
  double s = 5.63393378153785395e-8;
  for (double k : {-3.5986433529823097e-6, 0.000160441150742190911, -0.00468175413234097599,
                   0.0796926262460430031, -0.645964097506244316, 1.57079632679489661})
    s = k + r2 * s;
  s *= r;
  double c = 4.66320538869034346e-7;
  for (double k : {-0.000025200703761965413, 0.000919260101442624939, -0.0208634807531968792,
                   0.253669507900830424, -1.23370055013616907, 1.0})
    c = k + r2 * c;
  // Quarter 0, 1, 2, 3, 4: cos is c, -s, -c, s, c and sin is s, c, -s, -c, s.
  bool first = nearest == 1, second = nearest == 2, third = nearest == 3;
  bool odd = first | third;
  double cosine = odd ? s : c, sine = odd ? c : s;
  return {(first | second) ? -cosine : cosine, (second | third) ? -sine : sine};
}

/// atan2(y, x) for y >= 0, relative error below 2e-11: a polynomial for the arc tangent of the lesser over
/// the greater. Without branches, as above.
inline double angle_from_x_axis(double y, double x) {
  double along = std::abs(x);
  bool steep = y > along;
  double greater = steep ? y : along, lesser = steep ? along : y;
  double r = greater > 0 ? lesser / greater : 0.0, r2 = r * r;
  double p = 0.00041922786011272897;
  for (double k : {-0.0031954252407363944, 0.011427633277375594, -0.02600599597760862, 0.04364658944281667,
                   -0.06022196387937433, 0.07495262378099696, -0.09049179093720577, 0.11105306732424464,
                   -0.1428522560816021, 0.19999978336217084, -0.3333333295165722, 0.9999999999887381})
    p = k + r2 * p;
  double angle = r * p;
  angle = steep ? std::numbers::pi / 2 - angle : angle;
  return x < 0 ? std::numbers::pi - angle : angle;
}

} // namespace detail

/// A rectangle as seen from the origin of a space whose axes are along its edges: it spans [x0, x0 +
/// length_x] x [y0, y0 + length_y] at height z >= 0. Sampled uniformly in solid angle: density 1 /
/// solid_angle per sr.
///
/// The map is that of Ureña, Fajardo & King 2013, "An Area-Preserving Parametrization for Spherical
/// Rectangles", in another form. The part of it left of x covers
///     asin(b1 s) - asin(b0 s) - c0,   s = x / sqrt(x^2 + z^2),   b_j = y_j / sqrt(y_j^2 + z^2),
/// where c0 makes it 0 at x0. Set it to u.x times the whole and solve for s; with c = c0 + u.x solid_angle,
///     s = sin c / sqrt(b0^2 + b1^2 - 2 b0 b1 cos c),
/// which is the law of cosines. No arcs but the solid angle's are needed: c0 enters by its sine and cosine,
/// which are algebraic. Then y is distributed so that y / sqrt(x^2 + y^2 + z^2) is uniform. Double precision,
/// as differences of nearly equal terms measure a small rectangle; and no branches, for loops over many.
class ProjectedRectangle {
public:
  ProjectedRectangle(double x0, double y0, double z, double length_x, double length_y);

  /// In sr, in [0, 2 pi], relative error some 1e-6 where coordinates are rounded to floats; 0 in the
  /// rectangle's plane, where sample() means nothing.
  double solid_angle;

  /// How far along either edge from (x0, y0). u and v in [0, 1).
  struct Place {
    double x, y;
  };
  Place sample(double u, double v) const;

private:
  double x0_, y0_, x1_, y1_, z_, z2_;
  double b0_, b1_;
  double q_; ///< sqrt((1 - b0^2) (1 - b1^2))
  double sin_c0_, cos_c0_;
};

inline ProjectedRectangle::ProjectedRectangle(double x0, double y0, double z, double length_x,
                                              double length_y)
    : x0_(x0), y0_(y0), x1_(x0 + length_x), y1_(y0 + length_y), z_(z), z2_(z * z) {
  double x0x0 = x0_ * x0_, x1x1 = x1_ * x1_, y0y0 = y0_ * y0_, y1y1 = y1_ * y1_;
  double r00 = std::sqrt(x0x0 + y0y0 + z2_), r10 = std::sqrt(x1x1 + y0y0 + z2_);
  double r01 = std::sqrt(x0x0 + y1y1 + z2_), r11 = std::sqrt(x1x1 + y1y1 + z2_);
  double near_y0 = std::sqrt(y0y0 + z2_), near_y1 = std::sqrt(y1y1 + z2_), near_x0 = std::sqrt(x0x0 + z2_);

  // Van Oosterom & Strackee's tan(area / 2) = n / d of the two triangles on either side of the diagonal
  // 00-11. Their triple products are equal, and known without cancellation.
  double n = z_ * length_x * length_y;
  double dot_00_11 = x0_ * x1_ + y0_ * y1_ + z2_;
  double dot_00_10 = x0_ * x1_ + y0y0 + z2_, dot_10_11 = x1x1 + y0_ * y1_ + z2_;
  double dot_00_01 = x0x0 + y0_ * y1_ + z2_, dot_01_11 = x0_ * x1_ + y1y1 + z2_;
  double d1 = r00 * r10 * r11 + dot_00_10 * r11 + dot_10_11 * r00 + dot_00_11 * r10;
  double d2 = r00 * r01 * r11 + dot_00_01 * r11 + dot_01_11 * r00 + dot_00_11 * r01;
  // The sum of the two angles, each in [0, pi], of half the whole in [0, pi].
  double seen = 2 * detail::angle_from_x_axis(n * (d1 + d2), d1 * d2 - n * n);
  solid_angle = z_ > 0 ? seen : 0;

  double inverse_y0 = 1 / near_y0, inverse_y1 = 1 / near_y1, inverse_x0 = 1 / near_x0;
  b0_ = y0_ * inverse_y0;
  b1_ = y1_ * inverse_y1;
  q_ = z2_ * inverse_y0 * inverse_y1;
  // c0 = asin(b1 s0) - asin(b0 s0), and cos(asin(b_j s0)) = z r_0j / (near_x0 near_yj).
  double s0 = x0_ * inverse_x0;
  double sin1 = b1_ * s0, sin0 = b0_ * s0;
  double cos1 = z_ * r01 * (inverse_x0 * inverse_y1), cos0 = z_ * r00 * (inverse_x0 * inverse_y0);
  sin_c0_ = sin1 * cos0 - cos1 * sin0;
  cos_c0_ = cos1 * cos0 + sin1 * sin0;
}

inline ProjectedRectangle::Place ProjectedRectangle::sample(double u, double v) const {
  auto within = [](double value, double low, double high) {
    value = value > low ? value : low;
    return value < high ? value : high;
  };
  auto [cos_angle, sin_angle] = detail::cos_sin(u * solid_angle);
  double sin_c = sin_c0_ * cos_angle + cos_c0_ * sin_angle;
  double cos_c = cos_c0_ * cos_angle - sin_c0_ * sin_angle;
  // x = z s / sqrt(1 - s^2) = z sin c / sqrt(b0^2 + b1^2 - 2 b0 b1 cos c - sin^2 c), whose radicand is this
  // difference of squares; so written, it has digits even where the origin all but touches the rectangle.
  double a = cos_c - b0_ * b1_;
  double radicand = (a - q_) * (a + q_);
  double root = std::sqrt(radicand > 0 ? radicand : 1.0), end = sin_c > 0 ? x1_ : x0_;
  double x = z_ * sin_c / root;
  x = within(radicand > 0 ? x : end, x0_, x1_);

  double d2 = x * x + z2_;
  double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  double h = h0 + v * (h1 - h0);
  double one_minus_h2 = 1 - h * h;
  double inside = h * std::sqrt(d2 / (one_minus_h2 > 0 ? one_minus_h2 : 1.0));
  double y = within(one_minus_h2 > 0 ? inside : (h > 0 ? y1_ : y0_), y0_, y1_);
  return {x - x0_, y - y0_};
}

/// Many of them at once, each with one sample: a structure of arrays for the vector unit.
struct RectangleBatch {
  static constexpr std::size_t kSize = 64;
  using Doubles = std::array<double, kSize>;
  std::size_t count = 0;
  Doubles x0, y0, z, length_x, length_y; ///< as ProjectedRectangle takes them
  Doubles u, v;                          ///< as its sample() does
  Doubles solid_angle, x, y;             ///< what comes of it
};
void sample_rectangles(RectangleBatch& batch);

/// A rectangle in space, as seen from a point.
class SphericalRectangle {
public:
  /// The rectangle is corner + s edge_x + t edge_y for s, t in [0, 1]; edge_x and edge_y must be
  /// perpendicular. Any space, `origin` is the point that sees it.
  SphericalRectangle(vec3 corner, vec3 edge_x, vec3 edge_y, vec3 origin)
      : SphericalRectangle(corner, glm::normalize(edge_x), glm::normalize(edge_y),
                           glm::normalize(glm::cross(edge_x, edge_y)), glm::length(edge_x),
                           glm::length(edge_y), origin) {}
  /// The same with unit axes and normal, and lengths.
  SphericalRectangle(vec3 corner, vec3 axis_x, vec3 axis_y, vec3 normal, float length_x, float length_y,
                     vec3 origin)
      : corner_(corner), axis_x_(axis_x), axis_y_(axis_y),
        projected_(static_cast<double>(glm::dot(corner - origin, axis_x)),
                   static_cast<double>(glm::dot(corner - origin, axis_y)),
                   static_cast<double>(std::abs(glm::dot(corner - origin, normal))),
                   static_cast<double>(length_x), static_cast<double>(length_y)),
        solid_angle(static_cast<float>(projected_.solid_angle)) {}

private:
  vec3 corner_, axis_x_, axis_y_; ///< axes are unit
  ProjectedRectangle projected_;

public:
  /// In sr, in [0, 2 pi]. Where it is below kMinSolidAngle, because the rectangle is far away or seen
  /// edge-on, sample() is not accurate: the caller must sample the rectangle's area instead.
  float solid_angle = 0;
  static constexpr float kMinSolidAngle = 1e-5f;

  /// How far along either edge from the corner.
  vec2 place(vec2 u) const {
    auto [x, y] = projected_.sample(static_cast<double>(u.x), static_cast<double>(u.y));
    return {static_cast<float>(x), static_cast<float>(y)};
  }
  /// A point on the rectangle, in the constructor's space.
  vec3 sample(vec2 u) const {
    vec2 p = place(u);
    return corner_ + p.x * axis_x_ + p.y * axis_y_;
  }
};

} // namespace candela
