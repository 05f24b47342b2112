#pragma once

#include "textures/two_colors.h"

namespace candela {

/// Lines of color_b on a ground of color_a. They lie about the multiples of 1 / `squares`.
struct GridTexture : TwoColors<GridTexture> {
  static constexpr std::string_view kName = "grid";
  static std::span<const Field<GridTexture>> rows() {
    static const Field<GridTexture> table[] = {
        {{"color_a", FieldType::color, 0, 1e6, "", "Colour of the ground"},
         [](GridTexture& t) -> void* { return &t.color_a; }},
        {{"color_b", FieldType::color, 0, 1e6, "", "Colour of the lines"},
         [](GridTexture& t) -> void* { return &t.color_b; }},
        {{"squares", FieldType::real, 0.001, 1e6, "1/uv",
          "Squares along one unit of the texture coordinates"},
         [](GridTexture& t) -> void* { return &t.squares; }},
        {{"line_width", FieldType::real, 0, 1, "", "Width of a line as a share of a square"},
         [](GridTexture& t) -> void* { return &t.line_width; }},
    };
    return table;
  }

  float squares = 8, line_width = 0.1f;
  bool operator==(const GridTexture&) const = default;

  /// Endless: wrap and filter change nothing.
  float share(const TextureUse&, vec2 uv) const {
    return union_of(covered(squares * uv.x, 0), covered(squares * uv.y, 0));
  }
  /// The mean over an upright box of the footprint's second moments: exact for a footprint that is one.
  float mean_share(const TextureUse&, const TexturePoint& at) const {
    const vec2 a = squares * at.footprint.major, b = squares * at.footprint.minor;
    const vec2 sides = glm::sqrt(a * a + b * b), middle = squares * at.uv;
    return union_of(covered(middle.x, sides.x), covered(middle.y, sides.y));
  }
  vec2 cells() const { return vec2(squares); }

private:
  /// Of lines along both axes, each of which covers its share.
  static float union_of(float x, float y) { return x + y - x * y; }
  /// The share of a length about x that lines about the integers cover.
  float covered(float x, float length) const {
    constexpr float kPoint = 1e-3f, kMany = 1e5f; // a point; so many that they even out
    const float half = 0.5f * line_width;
    const float from_line = x - std::floor(x + 0.5f); // in [-1/2, 1/2]
    if (!(length > kPoint)) return std::abs(from_line) < half || line_width >= 1 ? 1.0f : 0.0f;
    if (!(length < kMany) || !std::isfinite(from_line)) return line_width;
    auto integral = [&](float y) { // from -1/2: whole lines, and what there is of one
      const float whole = std::floor(y + 0.5f), rest = y - whole;
      return whole * line_width + std::clamp(rest + half, 0.0f, line_width);
    };
    return std::clamp((integral(from_line + 0.5f * length) - integral(from_line - 0.5f * length)) / length,
                      0.0f, 1.0f);
  }
};

} // namespace candela
