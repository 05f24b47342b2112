#include "core/moving_transform.h"

#include <array>

namespace candela {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Angle between two points of a path that is bounded: the chord is off by at most its square over 8, 0.2 %
/// of the radius.
constexpr double kStep = kTurn / 48;

/// A corner's way about the pivot: rotate(begin + t change).
struct Corner {
  glm::dvec3 begin, change;
};

} // namespace

glm::dmat3 rotation_about(const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), one_minus_c = 2 * std::pow(std::sin(0.5 * angle), 2);
  const glm::dvec3 a = axis;
  glm::dmat3 m;
  m[0] = {c + a.x * a.x * one_minus_c, a.x * a.y * one_minus_c + a.z * s, a.x * a.z * one_minus_c - a.y * s};
  m[1] = {a.x * a.y * one_minus_c - a.z * s, c + a.y * a.y * one_minus_c, a.y * a.z * one_minus_c + a.x * s};
  m[2] = {a.x * a.z * one_minus_c + a.y * s, a.y * a.z * one_minus_c - a.x * s, c + a.z * a.z * one_minus_c};
  return m;
}

AxisAngle axis_angle(const glm::dmat3& r) {
  const glm::dvec3 v(r[1][2] - r[2][1], r[2][0] - r[0][2], r[0][1] - r[1][0]); // 2 sin(angle) axis
  const double sine = 0.5 * glm::length(v), cosine = 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1);
  const double angle = std::atan2(sine, cosine);
  if (sine > 1e-6) return {v / (2 * sine), angle};
  if (cosine > 0) return {{0, 0, 1}, 0};
  // Half a turn: r = 2 axis axis^T - 1, so that its longest column plus the identity's lies along the axis.
  glm::dvec3 longest(0);
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 column = r[k];
    column[k] += 1;
    if (glm::dot(column, column) > glm::dot(longest, longest)) longest = column;
  }
  return {glm::normalize(longest), angle};
}

glm::dmat4 MovingTransform::at(double time) const {
  const glm::dmat3 linear(world_from_object);
  const glm::dvec3 grown = glm::dvec3(1) + time * (scale - glm::dvec3(1));
  const glm::dmat3 turned = rotation_about(axis, time * angle) *
                            glm::dmat3(linear[0] * grown.x, linear[1] * grown.y, linear[2] * grown.z);
  const glm::dvec3 center = glm::dvec3(world_from_object * glm::dvec4(pivot, 1)) + time * translation;
  glm::dmat4 m(turned);
  m[3] = glm::dvec4(center - turned * pivot, 1);
  return m;
}

Bounds3 MovingTransform::bounds(const Bounds3& object) const {
  Bounds3 result;
  if (object.empty()) return result;
  const glm::dmat3 linear(world_from_object);
  const glm::dvec3 center(world_from_object * glm::dvec4(pivot, 1));
  std::array<Corner, 8> corners;
  double radius = 0, growth = 0; // greatest distance from the axis, and greatest change of it
  auto from_axis = [&](const glm::dvec3& v) { return glm::length(v - axis * glm::dot(axis, v)); };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 p(i & 1 ? object.hi.x : object.lo.x, i & 2 ? object.hi.y : object.lo.y,
                       i & 4 ? object.hi.z : object.lo.z);
    corners[i] = {linear * (p - pivot), linear * ((scale - glm::dvec3(1)) * (p - pivot))};
    radius = std::max({radius, from_axis(corners[i].begin), from_axis(corners[i].begin + corners[i].change)});
    growth = std::max(growth, from_axis(corners[i].change));
  }
  // Where there is nothing but rotation, all turns are the same.
  const bool repeats = translation == glm::dvec3(0) && growth == 0;
  const double turn = repeats ? std::clamp(angle, -kTurn, kTurn) : angle;
  const int steps = std::max(static_cast<int>(std::ceil(std::abs(turn) / kStep)), 1);
  glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    const glm::dmat3 rotation = rotation_about(axis, t * turn);
    for (const Corner& corner : corners) {
      const glm::dvec3 p = center + t * translation + rotation * (corner.begin + t * corner.change);
      lo = glm::min(lo, p), hi = glm::max(hi, p);
    }
  }
  // Second derivatives: of the rotation angle^2 radius, of rotation with growth 2 angle growth, both across
  // the axis, so that along a direction at an angle a to it they count by sin a.
  const glm::dvec3 across = glm::sqrt(glm::max(glm::dvec3(1) - axis * axis, glm::dvec3(0)));
  const glm::dvec3 bulge =
      across * ((turn * turn * radius + 2 * std::abs(turn) * growth) / (8.0 * steps * steps));
  const glm::dvec3 rounding = (glm::abs(lo) + glm::abs(hi)) * 0x1p-22;
  return {vec3(lo - bulge - rounding), vec3(hi + bulge + rounding)};
}

} // namespace candela
