#include "app/bench/scale_noise.h"

#include "core/hash.h"

#include <cmath>

namespace candela {

namespace {

std::uint32_t lattice(double x) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(x)); }

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t * (t - 2) + 1); }

/// A component of a lattice point's gradient, -1..1.
double signed_unit(std::uint32_t bits) { return 2 * static_cast<double>(to_unit_float(bits)) - 1; }

constexpr double kScale2 = 1.6, kScale3 = 1.5; ///< normalise the values to about -1..1

} // namespace

NoiseSample gradient_noise(glm::dvec2 p, std::uint32_t seed) {
  const glm::dvec2 cell(std::floor(p.x), std::floor(p.y)), f = p - cell;
  glm::dvec2 g[4];
  double v[4];
  for (std::uint32_t i = 0; i < 4; ++i) {
    const glm::dvec2 corner(i & 1, i >> 1);
    const std::uint32_t h =
        hash32(lattice(cell.x + corner.x) + hash32(lattice(cell.y + corner.y) + hash32(seed)));
    g[i] = {signed_unit(h), signed_unit(hash32(h))};
    v[i] = glm::dot(g[i], f - corner);
  }
  const double u = fade(f.x), w = fade(f.y), du = fade_slope(f.x), dw = fade_slope(f.y);
  const double twist = v[0] - v[1] - v[2] + v[3];
  const double value = v[0] + u * (v[1] - v[0]) + w * (v[2] - v[0]) + u * w * twist;
  const glm::dvec2 gradient = g[0] + u * (g[1] - g[0]) + w * (g[2] - g[0]) +
                              u * w * (g[0] - g[1] - g[2] + g[3]) +
                              glm::dvec2(du * (v[1] - v[0] + w * twist), dw * (v[2] - v[0] + u * twist));
  return {kScale2 * value, kScale2 * gradient};
}

double gradient_noise(glm::dvec3 p, std::uint32_t seed) {
  const glm::dvec3 cell(std::floor(p.x), std::floor(p.y), std::floor(p.z)), f = p - cell;
  const glm::dvec3 w(fade(f.x), fade(f.y), fade(f.z));
  double sum = 0;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const glm::dvec3 corner(i & 1, i >> 1 & 1, i >> 2);
    const std::uint32_t h =
        hash32(lattice(cell.x + corner.x) +
               hash32(lattice(cell.y + corner.y) + hash32(lattice(cell.z + corner.z) + hash32(seed))));
    const std::uint32_t h2 = hash32(h);
    const glm::dvec3 g(signed_unit(h), signed_unit(h2), signed_unit(hash32(h2)));
    const glm::dvec3 share = glm::mix(glm::dvec3(1) - w, w, corner);
    sum += share.x * share.y * share.z * glm::dot(g, f - corner);
  }
  return kScale3 * sum;
}

double fractal_noise(glm::dvec2 p, int octaves, std::uint32_t seed) {
  double sum = 0, strength = 0.5;
  for (int i = 0; i < octaves; ++i, p *= 2, strength /= 2)
    sum += strength * gradient_noise(p, seed + static_cast<std::uint32_t>(i)).value;
  return sum;
}

double fractal_noise(glm::dvec3 p, int octaves, std::uint32_t seed) {
  double sum = 0, strength = 0.5;
  for (int i = 0; i < octaves; ++i, p *= 2, strength /= 2)
    sum += strength * gradient_noise(p, seed + static_cast<std::uint32_t>(i));
  return sum;
}

double hashed_unit(std::uint32_t index, std::uint32_t seed) {
  return static_cast<double>(to_unit_float(hash32(index + hash32(seed))));
}

} // namespace candela
