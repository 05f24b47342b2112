#pragma once

#include "core/hash.h"
#include "textures/two_colors.h"

#include <array>

namespace candela {

/// Gradient noise over the plane (Perlin 2002, "Improving Noise"): 0 at the integers, with continuous second
/// derivatives, in [-1, 1]. Gradients are unit vectors of sixteen directions, chosen by a hash of the place
/// instead of a permutation table: the pattern does not repeat. A place so large that a float has no digits
/// left for the fraction, or none at all, gives 0.
inline float gradient_noise(vec2 p, std::uint32_t seed) {
  constexpr float kLargest = 0x1p22f;
  if (!(std::abs(p.x) < kLargest && std::abs(p.y) < kLargest)) return 0;
  const vec2 corner = glm::floor(p), f = p - corner;
  const auto x = static_cast<std::uint32_t>(static_cast<std::int32_t>(corner.x));
  const auto y = static_cast<std::uint32_t>(static_cast<std::int32_t>(corner.y));
  const auto slope = [](std::uint32_t h, vec2 d) {
    constexpr float a = 0.92387953f, b = 0.70710678f, c = 0.38268343f; // cosines of 22.5, 45, 67.5 degrees
    constexpr std::array<vec2, 16> kGradients = {{{1, 0},
                                                  {a, c},
                                                  {b, b},
                                                  {c, a},
                                                  {0, 1},
                                                  {-c, a},
                                                  {-b, b},
                                                  {-a, c},
                                                  {-1, 0},
                                                  {-a, -c},
                                                  {-b, -b},
                                                  {-c, -a},
                                                  {0, -1},
                                                  {c, -a},
                                                  {b, -b},
                                                  {a, -c}}};
    return glm::dot(kGradients[h >> 28], d);
  };
  const std::uint32_t below = hash32(y + seed), above = hash32(y + 1 + seed);
  const float n00 = slope(hash32(x + below), f), n10 = slope(hash32(x + 1 + below), f - vec2(1, 0));
  const float n01 = slope(hash32(x + above), f - vec2(0, 1)), n11 = slope(hash32(x + 1 + above), f - 1.0f);
  const vec2 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  // Unit gradients give at most sqrt(1/2), in the middle of a cell whose gradients point there.
  return std::numbers::sqrt2_v<float> * glm::mix(glm::mix(n00, n10, w.x), glm::mix(n01, n11, w.x), w.y);
}

enum class NoiseType : int { perlin, fbm, turbulence };

/// Noise between color_a and color_b: Perlin's of one scale; the sum of octaves of it (fractional Brownian
/// motion); the sum of their absolute values (turbulence, Perlin 1985), which has creases. A share of 1/2 is
/// where the first two are 0.
struct NoiseTexture : TwoColors<NoiseTexture> {
  static constexpr std::string_view kName = "noise";
  static constexpr std::string_view kTypes[] = {"perlin", "fbm", "turbulence"};
  static std::span<const Field<NoiseTexture>> rows() {
    static const Field<NoiseTexture> table[] = {
        {{"color_a", FieldType::color, 0, 1e6, "", "Colour where the noise is least"},
         [](NoiseTexture& t) -> void* { return &t.color_a; }},
        {{"color_b", FieldType::color, 0, 1e6, "", "Colour where the noise is greatest"},
         [](NoiseTexture& t) -> void* { return &t.color_b; }},
        {{"pattern", FieldType::choice, 0, 0, "",
          "Smooth spots of one size, spots of many sizes like clouds, or creases like marble",
          Invalidates::image, kTypes},
         [](NoiseTexture& t) -> void* { return &t.pattern; }},
        {{"frequency", FieldType::real, 0.001, 1e6, "1/uv",
          "Spots of the largest size along one unit of the texture coordinates"},
         [](NoiseTexture& t) -> void* { return &t.frequency; }},
        {{"octaves", FieldType::integer, 1, 16, "", "Sizes of spots that are added (fbm, turbulence)"},
         [](NoiseTexture& t) -> void* { return &t.octaves; }},
        {{"lacunarity", FieldType::real, 1, 8, "", "How many times finer each octave is than the one before"},
         [](NoiseTexture& t) -> void* { return &t.lacunarity; }},
        {{"gain", FieldType::real, 0, 1, "", "How strong each octave is to the one before"},
         [](NoiseTexture& t) -> void* { return &t.gain; }},
        {{"seed", FieldType::integer, 0, 1e9, "", "Another number, another pattern of the same kind"},
         [](NoiseTexture& t) -> void* { return &t.seed; }},
    };
    return table;
  }

  NoiseType pattern = NoiseType::fbm;
  float frequency = 8;
  int octaves = 6;
  float lacunarity = 2, gain = 0.5f;
  int seed = 0;
  bool operator==(const NoiseTexture&) const = default;

  /// Endless: wrap and filter change nothing.
  float share(const TextureUse&, vec2 uv) const { return at(uv, 0); }
  /// Octaves that are finer than the footprint give way to their mean.
  float mean_share(const TextureUse&, const TexturePoint& place) const {
    return mean_along_footprint(place, [this](vec2 uv, float width) { return at(uv, width); });
  }
  vec2 cells() const {
    return vec2(pattern == NoiseType::perlin
                    ? frequency
                    : frequency * std::pow(lacunarity, static_cast<float>(octaves - 1)));
  }

  /// Mean of |gradient_noise|: what turbulence has where it is too fine to see.
  static constexpr float kMeanCrease = 0.2492f;

private:
  float at(vec2 uv, float width) const {
    const bool creased = pattern == NoiseType::turbulence;
    const int count = pattern == NoiseType::perlin ? 1 : octaves;
    float sum = 0, most = 0, scale = frequency, weight = 1;
    for (int i = 0; i < count; ++i, scale *= lacunarity, weight *= gain) {
      most += weight;
      const float seen = 1 - glm::smoothstep(0.3f, 1.2f, scale * width);
      if (creased) sum += weight * (1 - seen) * kMeanCrease;
      if (!(seen > 0)) continue;
      const std::uint32_t key =
          hash32(static_cast<std::uint32_t>(seed) * 31u + static_cast<std::uint32_t>(i));
      // Octaves after the first are moved: else all would be 0 at the same places.
      const vec2 offset =
          i == 0 ? vec2(0) : vec2(to_unit_float(hash32(key + 1)), to_unit_float(hash32(key + 2)));
      const float n = gradient_noise(scale * uv + offset, key);
      sum += weight * seen * (creased ? std::abs(n) : n);
    }
    const float mean = sum / most;
    return std::clamp(creased ? mean : 0.5f + 0.5f * mean, 0.0f, 1.0f);
  }
};

} // namespace candela
