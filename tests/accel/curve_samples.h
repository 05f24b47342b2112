#pragma once
// Curves and rays for tests.

#include "accel/brute_force.h"
#include "support/seed.h"

namespace candela::test {

inline constexpr std::uint32_t kClosed = CurveSegment::closed_start | CurveSegment::closed_end;
inline constexpr std::uint32_t kCut = CurveSegment::cut_start | CurveSegment::cut_end;

inline glm::dvec4 curve_at(const CurveSegment& c, double u) {
  const double v = 1 - u;
  return v * v * v * glm::dvec4(c.points[0]) + 3 * u * v * v * glm::dvec4(c.points[1]) +
         3 * u * u * v * glm::dvec4(c.points[2]) + u * u * u * glm::dvec4(c.points[3]);
}

inline CurveSegment random_curve(Random& random, float bend, float radius, std::uint32_t flags) {
  CurveSegment c;
  const vec3 from = random.in_cube(), to = from + random.direction();
  for (std::size_t k = 0; k < 4; ++k) {
    const vec3 p =
        glm::mix(from, to, static_cast<float>(k) / 3) + (k % 3 != 0 ? random.in_cube(bend) : vec3(0));
    c.points[k] = vec4(p, radius * random.uniform(0.3f, 1));
  }
  c.flags = flags;
  return c;
}

inline Ray ray_near(Random& random, const CurveSegment& c, float off) {
  const vec3 target = vec3(glm::vec4(curve_at(c, static_cast<double>(random.uniform()))));
  const vec3 direction = random.direction();
  const vec3 aside = random.in_cube(off);
  return {target + aside - direction * random.uniform(2, 5), 0, direction * random.uniform(0.5f, 2),
          kInfinity};
}

/// Strands as pieces that share their ends.
inline std::vector<CurveSegment> wavy_strand(Random& random, std::size_t segments, float radius,
                                             std::uint32_t form) {
  std::vector<vec3> knots;
  vec3 p = random.in_cube(), direction = random.direction();
  for (std::size_t i = 0; i < segments + 3; ++i) {
    knots.push_back(p);
    direction = glm::normalize(direction + random.in_cube(0.8f));
    p += 0.2f * direction;
  }
  std::vector<CurveSegment> out;
  for (std::size_t i = 0; i < segments; ++i) {
    const glm::dvec3 a(knots[i]), b(knots[i + 1]), c(knots[i + 2]), d(knots[i + 3]);
    CurveSegment s;
    s.points = {vec4(vec3((a + 4.0 * b + c) / 6.0), radius), vec4(vec3((2.0 * b + c) / 3.0), radius),
                vec4(vec3((b + 2.0 * c) / 3.0), radius), vec4(vec3((b + 4.0 * c + d) / 6.0), radius)};
    s.flags = form;
    const bool ribbon = form == CurveSegment::ribbon;
    if (i == 0) s.flags |= ribbon ? CurveSegment::cut_start : CurveSegment::closed_start;
    if (i + 1 == segments) s.flags |= ribbon ? CurveSegment::cut_end : CurveSegment::closed_end;
    out.push_back(s);
  }
  return out;
}

} // namespace candela::test
