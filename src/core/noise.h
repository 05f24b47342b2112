#pragma once
// Noise in space: smooth values and scattered points, functions of the place and a seed alone.

#include "core/hash.h"
#include "core/math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace candela {

/// A value of noise, and its derivatives along x, y and z.
struct NoiseSlope {
  float value = 0;
  vec3 slope{0};
};

/// Beyond it a float has too few digits left for the place in a cell: noise is 0 there.
constexpr float kLargestNoisePlace = 0x1p22f;

inline bool has_noise(vec3 p) {
  return std::abs(p.x) < kLargestNoisePlace && std::abs(p.y) < kLargestNoisePlace &&
         std::abs(p.z) < kLargestNoisePlace;
}

/// Gradient noise (Perlin 2002, "Improving Noise"): 0 at the integers, with continuous second derivatives, in
/// [-1, 1]. Gradients are the twelve directions to the edges of a cube, chosen by a hash of the place instead
/// of a permutation table: the pattern does not repeat.
inline NoiseSlope gradient_noise_slope(vec3 p, std::uint32_t seed) {
  if (!has_noise(p)) return {};
  const vec3 corner = glm::floor(p), f = p - corner;
  const auto cell = [](float v) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(v)); };
  const std::uint32_t x = cell(corner.x), y = cell(corner.y), z = cell(corner.z);
  static constexpr std::array<vec3, 16> kGradients = {{{1, 1, 0},
                                                       {-1, 1, 0},
                                                       {1, -1, 0},
                                                       {-1, -1, 0},
                                                       {1, 0, 1},
                                                       {-1, 0, 1},
                                                       {1, 0, -1},
                                                       {-1, 0, -1},
                                                       {0, 1, 1},
                                                       {0, -1, 1},
                                                       {0, 1, -1},
                                                       {0, -1, -1},
                                                       {1, 1, 0}, // a regular tetrahedron again
                                                       {-1, 1, 0},
                                                       {0, -1, 1},
                                                       {0, -1, -1}}};
  const vec3 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  const vec3 dw = 30.0f * f * f * (f * (f - 2.0f) + 1.0f);
  const std::uint32_t key = hash32(seed); // else the next seed would be the same pattern, moved
  NoiseSlope sum;
  vec3 differences(0); // of the values between faces
  for (std::uint32_t k = 0; k < 2; ++k) {
    const std::uint32_t of_z = hash32(z + k + key);
    for (std::uint32_t j = 0; j < 2; ++j) {
      const std::uint32_t of_y = hash32(y + j + of_z);
      for (std::uint32_t i = 0; i < 2; ++i) {
        const vec3 gradient = kGradients[hash32(x + i + of_y) >> 28];
        const float value = glm::dot(gradient, f - vec3(i, j, k));
        const float wx = i != 0 ? w.x : 1 - w.x, wy = j != 0 ? w.y : 1 - w.y, wz = k != 0 ? w.z : 1 - w.z;
        sum.value += wx * wy * wz * value;
        sum.slope += wx * wy * wz * gradient;
        differences += value * vec3(i != 0 ? wy * wz : -wy * wz, j != 0 ? wx * wz : -wx * wz,
                                    k != 0 ? wx * wy : -wx * wy);
      }
    }
  }
  constexpr float kScale = 1 / 1.0363538f; // of the largest value that there is
  return {kScale * sum.value, kScale * (sum.slope + dw * differences)};
}

inline float gradient_noise(vec3 p, std::uint32_t seed) { return gradient_noise_slope(p, seed).value; }

/// A sum of octaves of gradient noise, each twice as fine and half as strong as the one before (fractional
/// Brownian motion), in [-1, 1].
inline float noise_octaves(vec3 p, int octaves, std::uint32_t seed) {
  float sum = 0, most = 0, weight = 1;
  for (int i = 0; i < octaves; ++i, weight *= 0.5f) {
    const std::uint32_t key = hash32(seed + static_cast<std::uint32_t>(i) * 0x9e3779b9u);
    // Octaves are moved: else all would be 0 at the integers.
    sum += weight * gradient_noise(p + 16.0f * vec3(to_unit_float(key), to_unit_float(hash32(key + 1)),
                                                    to_unit_float(hash32(key + 2))),
                                   key);
    most += weight;
    p *= 2.0f;
  }
  return most > 0 ? sum / most : 0;
}

/// A flow without sources: the curl of a potential of three noises (Bridson, Hourihan & Nordenstam 2007,
/// "Curl-Noise for Procedural Fluid Flow"). Its components are about 1 in size.
inline vec3 curl_noise(vec3 p, std::uint32_t seed) {
  const vec3 a = gradient_noise_slope(p, hash32(seed + 1)).slope;
  const vec3 b = gradient_noise_slope(p, hash32(seed + 2)).slope;
  const vec3 c = gradient_noise_slope(p, hash32(seed + 3)).slope;
  return {c.y - b.z, a.z - c.x, b.x - a.y};
}

/// Distance to the nearest of points that are scattered in space, one in each unit cube (Worley 1996, "A
/// Cellular Texture Basis Function"); at most sqrt(3).
inline float nearest_point_distance(vec3 p, std::uint32_t seed) {
  if (!has_noise(p)) return 0;
  const vec3 corner = glm::floor(p), f = p - corner;
  const auto cx = static_cast<std::int32_t>(corner.x), cy = static_cast<std::int32_t>(corner.y),
             cz = static_cast<std::int32_t>(corner.z);
  const std::uint32_t key = hash32(seed);
  float nearest = 3;
  const auto visit = [&](int i, int j, int k) {
    const std::uint32_t h =
        hash32(static_cast<std::uint32_t>(cx + i) +
               hash32(static_cast<std::uint32_t>(cy + j) + hash32(static_cast<std::uint32_t>(cz + k) + key)));
    const std::uint32_t h2 = hash32(h);
    const vec3 d =
        vec3(i, j, k) + vec3(to_unit_float(h), to_unit_float(h2), to_unit_float(h2 * 0x9e3779b9u + h)) - f;
    nearest = std::min(nearest, glm::dot(d, d));
  };
  const auto visit_shell = [&](int reach) {
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          if (reach == 1 || std::max({std::abs(i), std::abs(j), std::abs(k)}) == reach) visit(i, j, k);
  };
  visit_shell(1);
  const vec3 inside = glm::min(f, 1.0f - f);
  const float reach = 1 + std::min({inside.x, inside.y, inside.z}); // points of the next shell are farther
  if (nearest > reach * reach) visit_shell(2);
  return std::sqrt(nearest);
}

/// Octaves of round bumps: 1 at the scattered points, less between them; in (0, 1].
inline float billow_octaves(vec3 p, int octaves, std::uint32_t seed) {
  float sum = 0, most = 0, weight = 1;
  for (int i = 0; i < octaves; ++i, weight *= 0.5f) {
    const float d = nearest_point_distance(p, hash32(seed + static_cast<std::uint32_t>(i) * 0x85ebca6bu));
    sum += weight * std::max(1 - d * d, 0.0f);
    most += weight;
    p = p * 2.0f + vec3(0.37f, 0.71f, 0.19f);
  }
  return most > 0 ? sum / most : 0;
}

} // namespace candela
