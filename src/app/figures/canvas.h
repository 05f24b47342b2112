#pragma once
// An 8-bit picture to draw figures on: pictures, rectangles, smooth lines and text. A pure function of what
// is drawn: the same calls give the same bytes.

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

  /// What is drawn later stays within the box.
  void clip(const Box& box);
  void fill(const Box& box, Rgb8 color);
  /// A frame of the given thickness, inside of the box.
  void frame(const Box& box, int thickness, Rgb8 color);
  /// The part of the picture over the box: each pixel the mean of the part that it covers, so whole
  /// magnifications have hard pixels and reductions are smooth.
  void draw(const RgbPicture& picture, const Box& part, const Box& where);
  /// A line of round ends through the points, smooth at its edges.
  void line(std::span<const vec2> points, float width, Rgb8 color, bool dashed);
  void dot(vec2 center, float radius, Rgb8 color);
  void text(const Typeface& face, std::string_view text, float size, vec2 top_left, Rgb8 color);

private:
  void blend(int x, int y, Rgb8 color, float coverage);

  RgbPicture picture_;
  Box clip_;
};

} // namespace candela
