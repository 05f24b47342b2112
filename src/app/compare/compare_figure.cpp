// A comparison as shown on the screen, as a figure.

#include "app/compare/compare_mode.h"
#include "app/figures/figure.h"
#include "imaging/compare.h"
#include "imaging/difference.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr int kWidestPicture = 1280;
constexpr float kTextScaleWidth = 640; // wider pictures get larger text

RgbPicture without_alpha(std::span<const std::uint8_t> rgba, int width, int height) {
  RgbPicture out{width, height, {}};
  out.rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
    out.rgb.insert(out.rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return out;
}

FigurePanel difference_panel(const ComparisonFigure& source, std::span<const vec3> x, std::span<const vec3> r,
                             std::string title, int width, int height) {
  FigurePanel panel;
  panel.title = std::move(title);
  panel.picture = without_alpha(difference_rgba8(x, r, source.with_sign, source.range), width, height);
  if (source.with_sign) {
    ColorBar bar{{},
                 {-static_cast<double>(source.range), static_cast<double>(source.range), false},
                 "relative difference"};
    for (int i = 0; i < 256; ++i) bar.colors.push_back(map_signed_color(static_cast<float>(i) / 127.5f - 1));
    panel.bar = std::move(bar);
  } else {
    panel.bar = color_bar(ColorMap::magma, {1e-3, 1, true}, "relative error");
  }
  return panel;
}

bool fits_reference(const ComparisonFigure& source, const DisplayImage& shown) {
  return source.reference && shown.frame->width == source.reference->width &&
         shown.frame->height == source.reference->height;
}

} // namespace

std::string write_comparison_figure(const ComparisonFigure& source, const std::string& folder) {
  Figure figure;
  int widest = 1;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!source.pictures[i]) continue;
    const DisplayImage& shown = *source.pictures[i];
    widest = std::max(widest, shown.width);
    FigurePanel panel;
    panel.title = fmt::format("{}{}{}", variant_letter(static_cast<int>(i)),
                              source.labels[i].empty() ? "" : ": ", source.labels[i]);
    panel.caption.push_back(fmt::format("{} spp, {:.2f} s", shown.frame->spp, shown.frame->render_seconds));
    if (fits_reference(source, shown))
      panel.caption.push_back(
          fmt::format("relMSE {}", plot_number(relative_mse(shown.frame->linear, source.reference->pixels))));
    if (const auto noise = frame_noise(*shown.frame))
      panel.caption.push_back(fmt::format("{} {}", kNoiseName, plot_number(*noise)));
    panel.picture = without_alpha(shown.rgba, shown.width, shown.height);
    figure.panels.push_back(std::move(panel));
  }
  const auto& [a, b] = source.pictures;
  const std::size_t variant = source.difference == DifferenceOf::b_and_reference ? 1 : 0;
  if (source.difference != DifferenceOf::a_and_b && source.pictures[variant] &&
      fits_reference(source, *source.pictures[variant])) {
    const Frame& frame = *source.pictures[variant]->frame;
    figure.panels.push_back(
        difference_panel(source, frame.linear, source.reference->pixels,
                         fmt::format("{} and the reference", variant_letter(static_cast<int>(variant))),
                         frame.width, frame.height));
  } else if (a && b && a->width == b->width && a->height == b->height) {
    figure.panels.push_back(
        difference_panel(source, a->frame->linear, b->frame->linear, "A and B", a->width, a->height));
  }
  const bool has_points =
      std::ranges::any_of(source.plot.series, [](const PlotSeries& s) { return s.points.size() > 1; });
  if (has_points) {
    FigurePanel plot;
    plot.plot = source.plot;
    for (std::size_t i = 0; i < 2 && i < plot.plot->series.size(); ++i)
      if (!source.labels[i].empty()) plot.plot->series[i].label += ": " + source.labels[i];
    plot.whole_row = true;
    figure.panels.push_back(std::move(plot));
  }
  // Small pictures are magnified and large ones reduced, so that the figure is readable.
  figure.picture_width = std::clamp(widest, 320, kWidestPicture);
  figure.scale = std::max(1.0f, static_cast<float>(figure.picture_width) / kTextScaleWidth);
  const RgbPicture picture = draw_figure(figure, Typeface::installed());
  return write_srgb8_image_uniquely(picture.width, picture.height, picture.rgb, folder, "candela-compare");
}

} // namespace candela
