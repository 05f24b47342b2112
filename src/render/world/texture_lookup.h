#pragma once

#include "core/color.h"
#include "imaging/texture.h"

#include <array>

namespace candela {

/// Linear value of each sRGB byte.
inline const std::array<float, 256>& linear_from_srgb8() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = linear_from_srgb(static_cast<float>(i) / 255);
    return t;
  }();
  return table;
}

/// Linear Rec. 709 colour at uv: bilinear between texel centres, repeated outside [0, 1]; v = 0 is the bottom
/// row, as in OBJ. Decoded before it is blended, for light adds linearly.
inline vec3 lookup_bilinear(const Texture& texture, vec2 uv) {
  const auto& decode = linear_from_srgb8();
  auto wrap = [](int i, int n) { return i < 0 ? i + n : (i >= n ? i - n : i); };
  vec2 p = uv - glm::floor(uv); // in [0, 1], NaN stays NaN
  if (!(p.x >= 0 && p.y >= 0)) p = vec2(0);
  float x = p.x * static_cast<float>(texture.width) - 0.5f;
  float y = (1 - p.y) * static_cast<float>(texture.height) - 0.5f;
  float fx = std::floor(x), fy = std::floor(y);
  int x0 = wrap(static_cast<int>(fx), texture.width), x1 = wrap(x0 + 1, texture.width);
  int y0 = wrap(static_cast<int>(fy), texture.height), y1 = wrap(y0 + 1, texture.height);
  auto texel = [&](int i, int j) {
    const std::uint8_t* s =
        texture.srgb.data() + 3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(texture.width) +
                                   static_cast<std::size_t>(i));
    return vec3(decode[s[0]], decode[s[1]], decode[s[2]]);
  };
  return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), x - fx),
                  glm::mix(texel(x0, y1), texel(x1, y1), x - fx), y - fy);
}

} // namespace candela
