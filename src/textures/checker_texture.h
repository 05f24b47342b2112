#pragma once

#include "textures/texture_kind.h"

namespace candela {

/// Squares of two colours in turn; one that touches (0, 0) from above and the right is `even`.
struct CheckerTexture {
  static constexpr std::string_view kName = "checker";
  static std::span<const Field<CheckerTexture>> rows() {
    static const Field<CheckerTexture> table[] = {
        {{"even", FieldType::color, 0, 1e6, "", "Colour of the square at the origin and every second one"},
         [](CheckerTexture& t) -> void* { return &t.even; }},
        {{"odd", FieldType::color, 0, 1e6, "", "Colour of the squares between them"},
         [](CheckerTexture& t) -> void* { return &t.odd; }},
        {{"squares", FieldType::real, 0.001, 1e6, "1/uv",
          "Squares along one unit of the texture coordinates"},
         [](CheckerTexture& t) -> void* { return &t.squares; }},
    };
    return table;
  }

  vec3 even{0.8f}, odd{0.2f};
  float squares = 8;
  bool operator==(const CheckerTexture&) const = default;

  /// Endless: wrap and filter change nothing.
  vec3 color(const TextureUse& use, vec2 uv) const {
    const vec2 cell = glm::floor(squares * uv);
    const float sum = cell.x + cell.y;
    const bool is_odd = sum - 2 * std::floor(0.5f * sum) == 1;
    return texel_color(vec4(is_odd ? odd : even, 1), use.channel);
  }
  float number(const TextureUse& use, vec2 uv) const {
    TextureUse all = use;
    all.channel = TextureChannel::rgb;
    return texel_number(vec4(color(all, uv), 1), use.channel);
  }
  /// The mean over an upright box that is as wide as the footprint is on average (of the same second
  /// moments).
  vec4 filtered(const TextureUse&, const TexturePoint& at) const {
    const vec2 a = squares * at.footprint.major, b = squares * at.footprint.minor;
    const vec2 sides = glm::sqrt(a * a + b * b), middle = squares * at.uv;
    const float share = 0.5f * (1 + mean_stripe(middle.x, sides.x) * mean_stripe(middle.y, sides.y));
    return vec4(glm::mix(odd, even, share), 1);
  }
  vec2 cells() const { return vec2(squares); }
  std::size_t memory_bytes() const { return 0; }

private:
  /// Mean over a length of stripes that are 1 from 0 to 1, -1 to 2, and so on.
  static float mean_stripe(float middle, float length) {
    constexpr float kPoint = 1e-3f, kMany = 1e6f; // a point; so many that they even out
    auto phase = [](float x) { return x - 2 * std::floor(0.5f * x); };
    const float m = phase(middle);
    if (!(length > kPoint)) return m < 1 ? 1.0f : -1.0f;
    if (!(length < kMany)) return 0;
    auto integral = [&](float x) { return 1 - std::abs(phase(x) - 1); }; // from 0
    return (integral(m + 0.5f * length) - integral(m - 0.5f * length)) / length;
  }
};

} // namespace candela
