#pragma once
// Line plots as data, with one layout for the window (plot_widget.h) and for figures (figure.h).

#include "core/math.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace candela {

using Rgb8 = std::array<std::uint8_t, 3>; ///< sRGB

struct PlotPoint {
  double x = 0;
  double y = 0;
};

struct PlotSeries {
  std::string label;
  std::vector<PlotPoint> points;
  bool guide = false; ///< a thin dashed grey line: the expected slope of the others
};

struct PlotAxis {
  std::string label;
  bool logarithmic = false;
  bool from_zero = false; ///< a linear axis includes 0, so that heights can be compared
};

/// Points that are not finite, or not positive on a logarithmic axis, are left out.
struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
};

/// Okabe and Ito's colours ("Color Universal Design", 2008), distinguishable for the colour-blind; lighter on
/// dark backgrounds. Repeats after seven.
Rgb8 plot_color(std::size_t index, bool dark_ground = false);

/// The part of an axis that is shown.
struct PlotScale {
  double lo = 0;
  double hi = 1;
  bool logarithmic = false;

  double fraction(double value) const; ///< 0 at lo, 1 at hi
  double value(double fraction) const; ///< its inverse
};

struct PlotTick {
  double value = 0;
  std::string text;
};

/// The scales that hold all points of the series, except guides, with a small margin; defaults if there are
/// no points.
PlotScale x_scale(const Plot& plot);
PlotScale y_scale(const Plot& plot);

/// Round values within the scale, at most `most` (>= 2): decades, or 1-2-5 steps if it spans few decades.
std::vector<PlotTick> ticks(const PlotScale& scale, int most);

/// "0.00125", "3.2e-7": short, four digits.
std::string plot_number(double value);

/// The guide y = c / x over the plot's range, through the first point of its first series: how the mean
/// squared error of independent samples falls. Empty without points.
PlotSeries inverse_guide(const Plot& plot, std::string label);

/// The drawing operations of a plot. Positions are pixels from the top left.
class PlotPainter {
public:
  virtual ~PlotPainter() = default;
  virtual float text_width(std::string_view text) const = 0;
  virtual float text_height() const = 0;
  virtual void text(vec2 top_left, std::string_view text, Rgb8 color) = 0;
  virtual void fill(vec2 lo, vec2 hi, Rgb8 color) = 0;
  virtual void line(std::span<const vec2> points, Rgb8 color, float width, bool dashed) = 0;
  virtual void dot(vec2 center, float radius, Rgb8 color) = 0;
  /// Clips drawing to the rectangle until the next call.
  virtual void clip(vec2 lo, vec2 hi) = 0;
};

struct PlotTheme {
  float unit = 1; ///< pixels of a hairline; all distances scale with it
  bool dark = false;
};

/// The data's position in the plot, for read-outs.
struct PlotFrame {
  vec2 lo{0}, hi{0}; ///< of the area inside the axes
  PlotScale x, y;
  vec2 position(PlotPoint p) const;
};

/// Draws title, axes with ticks and grid, lines, and a legend in the corner where it covers least, all within
/// [lo, hi].
PlotFrame draw_plot(const Plot& plot, vec2 lo, vec2 hi, const PlotTheme& theme, PlotPainter& painter);

/// The strokes of a line: dashes of that length with gaps of the same length; 0: solid.
std::vector<std::pair<vec2, vec2>> strokes_of(std::span<const vec2> points, float dash);

/// The text, shortened with an ellipsis if it is wider than `room`.
std::string fitted_text(const PlotPainter& painter, std::string_view text, float room);

} // namespace candela
