#pragma once
// Structures of arrays, for loops over many points that compilers vectorise.
//
// A loop is vectorised if its arrays are plain floats or integers of 32 bits and of one object or __restrict,
// if it calls nothing that is not inlined, and if it has no branches: so items are selected and written to
// arrays first, processed uniformly in the loop, and evaluated afterwards.

#include "core/math.h"

#include <array>

namespace candela {

/// As many as are treated at once: enough for full vectors, and all that is known of them stays in the
/// first-level cache.
inline constexpr std::size_t kLaneCount = 64;

template <class T>
using Lanes = std::array<T, kLaneCount>;

/// Vectors, component by component.
struct Vec3Lanes {
  alignas(64) Lanes<float> x, y, z;

  vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
};

} // namespace candela
