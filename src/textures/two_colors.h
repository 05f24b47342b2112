#pragma once
// What the patterns between two colours have in common.

#include "textures/texture_kind.h"

namespace candela {

/// Base of a kind that has
///
///   share(use, uv)     how much there is of color_b, in [0, 1], at a point
///   mean_share(use, at)  its mean over the footprint of a TexturePoint
///
/// Alpha is 1.
template <class Kind>
struct TwoColors {
  vec3 color_a{0.2f}, color_b{0.8f};
  bool operator==(const TwoColors&) const = default;

  vec3 color(const TextureUse& use, vec2 uv) const {
    return texel_color(texel(kind().share(use, uv)), use.channel);
  }
  float number(const TextureUse& use, vec2 uv) const {
    return texel_number(texel(kind().share(use, uv)), use.channel);
  }
  vec4 filtered(const TextureUse& use, const TexturePoint& at) const {
    return texel(at.is_point() ? kind().share(use, at.uv) : kind().mean_share(use, at));
  }
  std::size_t memory_bytes() const { return 0; }

private:
  const Kind& kind() const { return static_cast<const Kind&>(*this); }
  vec4 texel(float share) const { return vec4(glm::mix(color_a, color_b, share), 1); }
};

/// The mean of value(uv, width) over a footprint, where `width` is the side of the square that value() takes
/// the mean over by itself: as many squares along the longer axis as fit, up to eight.
template <class Value>
float mean_along_footprint(const TexturePoint& at, Value value) {
  vec2 along = at.footprint.major;
  float length = glm::length(along), across = glm::length(at.footprint.minor);
  if (across > length) std::swap(length, across), along = at.footprint.minor;
  constexpr float kEverything = 1e30f; // also of what is no number
  if (!(length < kEverything && across < kEverything)) return value(at.uv, kEverything);
  const float fitting = across > 0 ? length / across : kInfinity;
  const int count = fitting < 8 ? std::max(static_cast<int>(fitting + 0.5f), 1) : 8;
  const float width = std::max(across, length / static_cast<float>(count));
  float sum = 0;
  for (int i = 0; i < count; ++i)
    sum += value(at.uv + ((static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 0.5f) * along, width);
  return sum / static_cast<float>(count);
}

} // namespace candela
