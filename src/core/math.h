#pragma once
// Vectors are GLM's; this header gives them their names here and adds the few functions that rendering needs.

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace candela {

using glm::ivec2;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// The largest float below 1: random numbers live in [0, 1).
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

constexpr float sqr(float x) { return x * x; }
/// sqrt that clamps rounding errors below 0.
inline float safe_sqrt(float x) { return std::sqrt(std::max(x, 0.0f)); }
inline float max_component(vec3 v) { return std::max(std::max(v.x, v.y), v.z); }
inline float min_component(vec3 v) { return std::min(std::min(v.x, v.y), v.z); }
/// condition ? a : b without a branch, for unpredictable conditions.
inline float select(bool condition, float a, float b) {
  auto mask = 0 - static_cast<std::uint32_t>(condition);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                              (std::bit_cast<std::uint32_t>(b) & ~mask));
}
inline vec3 select(bool condition, vec3 a, vec3 b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
inline float average(vec3 v) { return (v.x + v.y + v.z) * (1.0f / 3.0f); }
inline bool is_finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline bool is_black(vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }
inline float length_squared(vec3 v) { return glm::dot(v, v); }

constexpr float radians(float degrees) { return degrees * (kPi / 180.0f); }
constexpr float degrees(float radians) { return radians * (180.0f / kPi); }

/// Bound of the relative error of n float operations, Higham's gamma_n (pbrt-v4, eq. 6.22).
constexpr float gamma_bound(int n) {
  constexpr float epsilon = std::numeric_limits<float>::epsilon() * 0.5f;
  return (static_cast<float>(n) * epsilon) / (1 - static_cast<float>(n) * epsilon);
}

/// Position and direction under an affine transform.
inline vec3 transform_point(const mat4& m, vec3 p) { return vec3(m * vec4(p, 1)); }
inline vec3 transform_vector(const mat4& m, vec3 v) { return vec3(m * vec4(v, 0)); }

} // namespace candela
