#pragma once

#include "core/hash.h"
#include "textures/two_colors.h"

namespace candela {

/// Distances to the nearest two of points that are scattered over the plane, one in each unit square: at its
/// middle, and up to `jitter` halves off it (Worley 1996, "A Cellular Texture Basis Function"). A place where
/// floats have no digits left gives 0 and 0.
struct CellDistances {
  float first = 0, second = 0;
};
inline CellDistances cell_distances(vec2 p, float jitter, std::uint32_t seed) {
  constexpr float kLargest = 0x1p22f;
  if (!(std::abs(p.x) < kLargest && std::abs(p.y) < kLargest)) return {};
  const vec2 corner = glm::floor(p), f = p - corner;
  const auto cx = static_cast<std::int32_t>(corner.x), cy = static_cast<std::int32_t>(corner.y);
  float first = kInfinity, second = kInfinity; // squared
  auto visit = [&](int i, int j) {
    const std::uint32_t h =
        hash32(static_cast<std::uint32_t>(cx + i) + hash32(static_cast<std::uint32_t>(cy + j) + seed));
    const vec2 random(to_unit_float(h), to_unit_float(hash32(h)));
    const vec2 d = vec2(i, j) + 0.5f + jitter * (random - 0.5f) - f;
    const float d2 = glm::dot(d, d);
    second = std::min(second, std::max(first, d2));
    first = std::min(first, d2);
  };
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) visit(i, j);
  // Points of the next squares are at least this far. Those after them are too far for the second nearest,
  // which is less than 2 away.
  const vec2 inside = glm::min(f, 1.0f - f);
  const float reach = 1 + std::min(inside.x, inside.y);
  if (second > reach * reach)
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i)
        if (std::max(std::abs(i), std::abs(j)) == 2) visit(i, j);
  return {std::sqrt(first), std::sqrt(second)};
}

enum class WorleyDistance : int { first, second_minus_first };

/// Cells between color_a and color_b: by the distance from their points, or from their borders (the second
/// least distance less the least). Distances of a cell's side and more are color_b.
struct WorleyTexture : TwoColors<WorleyTexture> {
  static constexpr std::string_view kName = "worley";
  static constexpr std::string_view kDistances[] = {"f1", "f2-f1"};
  static std::span<const Field<WorleyTexture>> rows() {
    static const Field<WorleyTexture> table[] = {
        {{"color_a", FieldType::color, 0, 1e6, "",
          "Colour at the points of the cells (f1), or their borders"},
         [](WorleyTexture& t) -> void* { return &t.color_a; }},
        {{"color_b", FieldType::color, 0, 1e6, "", "Colour far from them"},
         [](WorleyTexture& t) -> void* { return &t.color_b; }},
        {{"distance", FieldType::choice, 0, 0, "",
          "f1: from the nearest point; f2-f1: from the border to the next cell", Invalidates::image,
          kDistances},
         [](WorleyTexture& t) -> void* { return &t.distance; }},
        {{"frequency", FieldType::real, 0.001, 1e6, "1/uv",
          "Cells along one unit of the texture coordinates"},
         [](WorleyTexture& t) -> void* { return &t.frequency; }},
        {{"jitter", FieldType::real, 0, 1, "", "From a regular grid of cells (0) to scattered ones (1)"},
         [](WorleyTexture& t) -> void* { return &t.jitter; }},
        {{"seed", FieldType::integer, 0, 1e9, "", "Another number, another pattern of the same kind"},
         [](WorleyTexture& t) -> void* { return &t.seed; }},
    };
    return table;
  }

  WorleyDistance distance = WorleyDistance::first;
  float frequency = 8, jitter = 1;
  int seed = 0;
  bool operator==(const WorleyTexture&) const = default;

  /// Endless: wrap and filter change nothing.
  float share(const TextureUse&, vec2 uv) const {
    const CellDistances d =
        cell_distances(frequency * uv, jitter, hash32(static_cast<std::uint32_t>(seed) + 0x51ed270bu));
    return std::min(distance == WorleyDistance::first ? d.first : d.second - d.first, 1.0f);
  }
  /// Four lookups a square of the footprint; cells that are smaller give way to their mean.
  float mean_share(const TextureUse& use, const TexturePoint& place) const {
    return mean_along_footprint(place, [&](vec2 uv, float width) {
      const float seen = 1 - glm::smoothstep(0.8f, 2.5f, frequency * width), q = 0.25f * width;
      if (!(seen > 0)) return mean();
      float sum = 0;
      for (vec2 off : {vec2(-q, -q), vec2(q, -q), vec2(-q, q), vec2(q, q)})
        sum += 0.25f * share(use, uv + off);
      return glm::mix(mean(), sum, seen);
    });
  }
  vec2 cells() const { return vec2(frequency); }

  /// Of share() over the plane: a parabola in the jitter through the values for 0, where it is known (f1: the
  /// mean distance in a unit square from its middle), and measured ones for 1/2 and 1.
  float mean() const {
    const bool nearest = distance == WorleyDistance::first;
    const vec3 at = nearest ? vec3(0.3826f, 0.3960f, 0.4296f) : vec3(0.3171f, 0.3058f, 0.2694f);
    const float b = 4 * at.y - 3 * at.x - at.z, c = 2 * at.x + 2 * at.z - 4 * at.y;
    return at.x + jitter * (b + jitter * c);
  }
};

} // namespace candela
