#pragma once
// Sampling of what a rectangle or triangle covers of the sphere around a point.

#include "core/math.h"

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
/// every machine and at half the cost of libm's.
inline CosSin cos_sin(double angle) {
  double quarters = angle * (2 * std::numbers::inv_pi);
  double nearest = std::floor(quarters + 0.5);
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
  switch (static_cast<int>(nearest) & 3) {
  case 0: return {c, s};
  case 1: return {-s, c};
  case 2: return {-c, -s};
  default: return {s, -c};
  }
}

} // namespace detail

/// A rectangle as seen from a point, sampled uniformly in solid angle: density 1 / solid_angle per sr.
///
/// The map is that of Ureña, Fajardo & King 2013, "An Area-Preserving Parametrization for Spherical
/// Rectangles", in another form. Put the origin at 0 and the rectangle at height z > 0, spanning x0..x1 and
/// y0..y1. The part of it left of x covers
///     asin(b1 s) - asin(b0 s) - c0,   s = x / sqrt(x^2 + z^2),   b_j = y_j / sqrt(y_j^2 + z^2),
/// where c0 makes it 0 at x0. Set it to u.x times the whole and solve for s; with c = c0 + u.x solid_angle,
///     s = sin c / sqrt(b0^2 + b1^2 - 2 b0 b1 cos c),
/// which is the law of cosines. No arcs but the solid angle's are needed: c0 enters by its sine and cosine,
/// which are algebraic. Then y is distributed so that y / sqrt(x^2 + y^2 + z^2) is uniform. Double precision,
/// as differences of nearly equal terms measure a small rectangle.
class SphericalRectangle {
public:
  /// The rectangle is corner + s edge_x + t edge_y for s, t in [0, 1]; edge_x and edge_y must be
  /// perpendicular. Any space, `origin` is the point that sees it.
  SphericalRectangle(vec3 corner, vec3 edge_x, vec3 edge_y, vec3 origin);

  /// In sr, in [0, 2 pi], relative error some 1e-6. Where it is below kMinSolidAngle, because the rectangle
  /// is far away or seen edge-on, sample() is not accurate: the caller must sample the rectangle's area
  /// instead.
  float solid_angle = 0;
  static constexpr float kMinSolidAngle = 1e-5f;

  /// A point on the rectangle, in the constructor's space.
  vec3 sample(vec2 u) const;

private:
  vec3 corner_, axis_x_, axis_y_; ///< axes are unit
  double x0_, y0_, x1_, y1_, z2_, z_;
  double b0_ = 0, b1_ = 0;
  double q_ = 0; ///< sqrt((1 - b0^2) (1 - b1^2))
  double sin_c0_ = 0, cos_c0_ = 1;
  double exact_solid_angle_ = 0;
};

inline SphericalRectangle::SphericalRectangle(vec3 corner, vec3 edge_x, vec3 edge_y, vec3 origin)
    : corner_(corner) {
  float length_x = glm::length(edge_x), length_y = glm::length(edge_y);
  axis_x_ = edge_x / length_x;
  axis_y_ = edge_y / length_y;
  vec3 to_corner = corner - origin;
  x0_ = glm::dot(to_corner, axis_x_);
  y0_ = glm::dot(to_corner, axis_y_);
  z_ = std::abs(glm::dot(to_corner, glm::cross(axis_x_, axis_y_)));
  x1_ = x0_ + length_x;
  y1_ = y0_ + length_y;
  z2_ = z_ * z_;

  double x0x0 = x0_ * x0_, x1x1 = x1_ * x1_, y0y0 = y0_ * y0_, y1y1 = y1_ * y1_;
  double r00 = std::sqrt(x0x0 + y0y0 + z2_), r10 = std::sqrt(x1x1 + y0y0 + z2_);
  double r01 = std::sqrt(x0x0 + y1y1 + z2_), r11 = std::sqrt(x1x1 + y1y1 + z2_);
  double near_y0 = std::sqrt(y0y0 + z2_), near_y1 = std::sqrt(y1y1 + z2_), near_x0 = std::sqrt(x0x0 + z2_);
  if (!(z_ > 0)) return; // in the rectangle's plane, or no rectangle at all

  // Van Oosterom & Strackee's tan(area / 2) = n / d of the two triangles on either side of the diagonal
  // 00-11. Their triple products are equal, and known without cancellation.
  double n = z_ * length_x * length_y;
  double dot_00_11 = x0_ * x1_ + y0_ * y1_ + z2_;
  double dot_00_10 = x0_ * x1_ + y0y0 + z2_, dot_10_11 = x1x1 + y0_ * y1_ + z2_;
  double dot_00_01 = x0x0 + y0_ * y1_ + z2_, dot_01_11 = x0_ * x1_ + y1y1 + z2_;
  double d1 = r00 * r10 * r11 + dot_00_10 * r11 + dot_10_11 * r00 + dot_00_11 * r10;
  double d2 = r00 * r01 * r11 + dot_00_01 * r11 + dot_01_11 * r00 + dot_00_11 * r01;
  // The sum of the two angles, each in [0, pi], of half the whole in [0, pi].
  exact_solid_angle_ = 2 * std::atan2(n * (d1 + d2), d1 * d2 - n * n);
  solid_angle = static_cast<float>(exact_solid_angle_);

  b0_ = y0_ / near_y0;
  b1_ = y1_ / near_y1;
  q_ = z2_ / (near_y0 * near_y1);
  // c0 = asin(b1 s0) - asin(b0 s0), and cos(asin(b_j s0)) = z r_0j / (near_x0 near_yj).
  double s0 = x0_ / near_x0;
  double sin1 = b1_ * s0, sin0 = b0_ * s0;
  double cos1 = z_ * r01 / (near_x0 * near_y1), cos0 = z_ * r00 / (near_x0 * near_y0);
  sin_c0_ = sin1 * cos0 - cos1 * sin0;
  cos_c0_ = cos1 * cos0 + sin1 * sin0;
}

inline vec3 SphericalRectangle::sample(vec2 u) const {
  auto [cos_angle, sin_angle] = detail::cos_sin(static_cast<double>(u.x) * exact_solid_angle_);
  double sin_c = sin_c0_ * cos_angle + cos_c0_ * sin_angle;
  double cos_c = cos_c0_ * cos_angle - sin_c0_ * sin_angle;
  // x = z s / sqrt(1 - s^2) = z sin c / sqrt(b0^2 + b1^2 - 2 b0 b1 cos c - sin^2 c), whose radicand is this
  // difference of squares; so written, it has digits even where the origin all but touches the rectangle.
  double a = cos_c - b0_ * b1_;
  double radicand = (a - q_) * (a + q_);
  double x = radicand > 0 ? z_ * sin_c / std::sqrt(radicand) : (sin_c > 0 ? x1_ : x0_);
  x = std::clamp(x, x0_, x1_);

  double d2 = x * x + z2_;
  double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  double h = h0 + static_cast<double>(u.y) * (h1 - h0);
  double one_minus_h2 = 1 - h * h;
  double y = one_minus_h2 > 0 ? h * std::sqrt(d2 / one_minus_h2) : (h > 0 ? y1_ : y0_);
  y = std::clamp(y, y0_, y1_);
  return corner_ + static_cast<float>(x - x0_) * axis_x_ + static_cast<float>(y - y0_) * axis_y_;
}

} // namespace candela
