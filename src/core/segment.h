#pragma once
// Line segments in the plane.

#include "core/math.h"

namespace candela {

/// Of a point from the segment between a and b, which may coincide.
inline float distance_to_segment(vec2 p, vec2 a, vec2 b) {
  const vec2 along = b - a;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
  return glm::length(p - a - t * along);
}

} // namespace candela
