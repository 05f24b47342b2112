#pragma once
// Orthonormal basis around a normal; in its local space the normal is +z, so cos(theta) is w.z.

#include "core/math.h"

namespace candela {

struct Basis {
  vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

  /// From a unit normal, without branches (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
  static Basis from_normal(vec3 n) {
    float sign = std::copysign(1.0f, n.z);
    float a = -1.0f / (sign + n.z);
    float b = n.x * n.y * a;
    return {vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n};
  }

  vec3 to_local(vec3 w) const { return {glm::dot(w, s), glm::dot(w, t), glm::dot(w, n)}; }
  vec3 to_world(vec3 w) const { return s * w.x + t * w.y + n * w.z; }
};

} // namespace candela
