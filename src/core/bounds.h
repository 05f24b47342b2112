#pragma once
// Axis-aligned box; the default one is empty, and growing an empty box by a point gives the point. And how
// large it may be.

#include "core/math.h"

namespace candela {

/// Beyond this, products of coordinates overflow: such primitives are left out of pictures.
inline constexpr float kMaxCoordinate = 1e12f;

struct Bounds3 {
  vec3 lo{kInfinity};
  vec3 hi{-kInfinity};

  void grow(vec3 p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  void grow(const Bounds3& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
  bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  vec3 diagonal() const { return hi - lo; }
  vec3 center() const { return 0.5f * (lo + hi); }
  /// Half the surface area, which is all that the surface area heuristic needs; 0 when empty.
  float half_area() const {
    if (empty()) return 0;
    vec3 d = diagonal();
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
  bool operator==(const Bounds3&) const = default;
};

} // namespace candela
