#pragma once
// Figures for papers and lessons: pictures and plots in a grid, with titles, captions, magnified details and
// colour bars. Pure functions: the same figure gives the same bytes.

#include "app/figures/canvas.h"
#include "imaging/color_map.h"

#include <optional>
#include <string>
#include <vector>

namespace candela {

/// The legend below a false-colour picture.
struct ColorBar {
  std::vector<Rgb8> colors; ///< from left to right
  PlotScale scale;
  std::string label;
};

/// The bar of a colour map.
ColorBar color_bar(ColorMap map, const PlotScale& scale, std::string label);

/// A picture or a plot with its texts.
struct FigurePanel {
  std::string title;                ///< above, may be empty
  std::vector<std::string> caption; ///< lines beneath
  RgbPicture picture;               ///< empty for a plot or an empty panel
  std::optional<Plot> plot;
  std::optional<ColorBar> bar;
  bool whole_row = false; ///< spans all columns
};

struct Figure {
  std::string title; ///< may be empty
  int columns = 0;   ///< 0: all panels in one row
  float scale = 1;   ///< of text, lines and gaps; 1 is text of 15 pixels
  /// Width that pictures are scaled to, pixels: magnified by the largest integer that fits, or reduced. 0:
  /// not scaled.
  int picture_width = 0;
  std::vector<Box> details; ///< parts of every picture, in its pixels, shown magnified beneath it
  std::vector<FigurePanel> panels;
};

/// The position of an item. Items do not overlap, and all lie within the figure.
struct FigureItem {
  enum class Kind { title, panel_title, picture, detail, plot, bar, caption } kind = Kind::title;
  std::size_t panel = 0;  ///< index of the panel; unused by the title
  std::size_t detail = 0; ///< index of the detail
  Box box;
  std::string text; ///< of title, panel_title, caption
  float text_size = 0;
};

struct FigureLayout {
  int width = 0;
  int height = 0;
  std::vector<FigureItem> items;
};

/// Titles and captions are broken into lines that fit their panels.
FigureLayout layout_figure(const Figure& figure, const Typeface& face);

RgbPicture draw_figure(const Figure& figure, const Typeface& face);

/// Colour of the frame of the details with that number.
Rgb8 detail_color(std::size_t index);

} // namespace candela
