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
  vec2 cells() const { return vec2(squares); }
  std::size_t memory_bytes() const { return 0; }
};

} // namespace candela
