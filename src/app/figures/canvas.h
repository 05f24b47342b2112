#pragma once
// An 8-bit picture to draw on: pictures, rectangles, antialiased lines and text. The same calls give the same
// bytes.

#include "app/figures/plot.h"
#include "app/figures/typeface.h"

namespace candela {

/// Pixels, origin at the top left.
struct Box {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Box&) const = default;
};

/// 8-bit sRGB, row 0 is the top, three bytes a pixel.
struct RgbPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

class Canvas {
public:
  Canvas(int width, int height, Rgb8 ground);

  const RgbPicture& picture() const { return picture_; }

  /// Clips later drawing to the box.
  void clip(const Box& box);
  void fill(const Box& box, Rgb8 color);
  /// A frame of the given thickness, inside the box.
  void frame(const Box& box, int thickness, Rgb8 color);
  /// Scales the part of the picture to the box. Each pixel is the mean of the area that it covers, so integer
  /// magnifications have sharp pixels and reductions are smooth.
  void draw(const RgbPicture& picture, const Box& part, const Box& where);
  /// An antialiased line with round ends through the points.
  void line(std::span<const vec2> points, float width, Rgb8 color, bool dashed);
  void dot(vec2 center, float radius, Rgb8 color);
  void text(const Typeface& face, std::string_view text, float size, vec2 top_left, Rgb8 color);

private:
  void blend(int x, int y, Rgb8 color, float coverage);

  RgbPicture picture_;
  Box clip_;
};

} // namespace candela
