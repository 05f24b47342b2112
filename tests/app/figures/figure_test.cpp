#include "app/figures/figure.h"
#include "io/images/image_file.h"
#include "support/screenshots.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

RgbPicture ramp(int width, int height) {
  RgbPicture p{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        p.rgb.push_back(static_cast<std::uint8_t>(c == 0 ? 255 * x / width : c == 1 ? 255 * y / height : 90));
  return p;
}

Plot convergence() {
  Plot plot{"relMSE", {"samples a pixel", true}, {"relMSE", true}, {}};
  for (double c : {1.0, 0.3}) {
    PlotSeries series{c < 1 ? "Sobol'" : "independent", {}, false};
    for (double n = 1; n <= 1024; n *= 2) series.points.push_back({n, c * std::pow(n, c < 1 ? -1.4 : -1)});
    plot.series.push_back(series);
  }
  plot.series.push_back(inverse_guide(plot, "1/N"));
  return plot;
}

Figure everything(float scale) {
  Figure figure;
  figure.title = "Four samplers at the same number of samples: the noise shows how good a strategy is";
  figure.scale = scale;
  figure.columns = 2;
  figure.picture_width = static_cast<int>(256 * scale);
  figure.details = {{10, 10, 16, 12}, {50, 40, 16, 12}};
  for (int i = 0; i < 3; ++i) {
    FigurePanel panel;
    panel.title = i == 0 ? "Independent" : "A title that is much too long for the narrow picture beneath it";
    panel.caption = {"64 spp, 1.23 s, relMSE 0.0123",
                     "Averyveryverylongwordwithoutanyspacethatcanneverfitintotheline"};
    panel.picture = ramp(96, 72 + 10 * i);
    if (i == 1) panel.bar = color_bar(ColorMap::magma, {1e-3, 1, true}, "relative error");
    figure.panels.push_back(panel);
  }
  FigurePanel plot;
  plot.title = "Convergence";
  plot.plot = convergence();
  figure.panels.push_back(plot);
  return figure;
}

bool disjoint(const Box& a, const Box& b) {
  return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
}

TEST(Figure, NothingOverlapsAndAllIsInside) {
  const Typeface face = Typeface::installed();
  for (float scale : {0.75f, 1.0f, 2.0f}) {
    const Figure figure = everything(scale);
    const FigureLayout layout = layout_figure(figure, face);
    std::size_t texts = 0;
    for (std::size_t i = 0; i < layout.items.size(); ++i) {
      const FigureItem& item = layout.items[i];
      EXPECT_GE(item.box.x, 0);
      EXPECT_GE(item.box.y, 0);
      EXPECT_LE(item.box.x + item.box.width, layout.width);
      EXPECT_LE(item.box.y + item.box.height, layout.height);
      EXPECT_GT(item.box.width, 0);
      EXPECT_GT(item.box.height, 0);
      if (!item.text.empty()) {
        ++texts;
        EXPECT_LE(face.text_width(item.text, item.text_size), static_cast<float>(item.box.width));
        EXPECT_LE(item.text_size, static_cast<float>(item.box.height));
      }
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_TRUE(disjoint(item.box, layout.items[j].box)) << i << ' ' << j << " at scale " << scale;
    }
    EXPECT_GE(texts, 10u);
  }
}

TEST(Figure, NoWordIsLost) {
  const Typeface face = Typeface::installed();
  const Figure figure = everything(1);
  std::string said, shown;
  for (char c : figure.title + figure.panels[0].caption[1])
    if (c != ' ') said += c;
  for (const FigureItem& item : layout_figure(figure, face).items)
    if (item.kind == FigureItem::Kind::title) shown += item.text;
  for (const FigureItem& item : layout_figure(figure, face).items)
    if (item.kind == FigureItem::Kind::caption && item.panel == 0 &&
        item.text.find("spp") == std::string::npos)
      shown += item.text;
  std::erase(shown, ' ');
  EXPECT_EQ(shown, said);
}

TEST(Figure, ThePicturesPixelsAreKeptAndMagnifiedHard) {
  const Typeface face = Typeface::installed();
  Figure figure;
  figure.panels = {FigurePanel{"", {}, ramp(200, 50), std::nullopt, std::nullopt}};
  for (int zoom : {1, 3}) {
    figure.picture_width = zoom == 1 ? 0 : 3 * 200 + 50;
    const FigureLayout layout = layout_figure(figure, face);
    const RgbPicture drawn = draw_figure(figure, face);
    ASSERT_EQ(layout.items.size(), 1u);
    const Box box = layout.items[0].box;
    ASSERT_EQ(box.width, 200 * zoom);
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(
              drawn.rgb[static_cast<std::size_t>(3 * ((box.y + y) * drawn.width + box.x + x) + c)],
              figure.panels[0].picture.rgb[static_cast<std::size_t>(3 * (y / zoom * 200 + x / zoom) + c)])
              << x << ' ' << y;
  }
}

TEST(Figure, AReducedPictureKeepsItsMean) {
  Canvas canvas(40, 40, {0, 0, 0});
  RgbPicture noise{400, 400, {}};
  std::mt19937 random(7);
  double mean = 0;
  for (int i = 0; i < 3 * 400 * 400; ++i) {
    noise.rgb.push_back(static_cast<std::uint8_t>(random() & 255));
    mean += noise.rgb.back();
  }
  canvas.draw(noise, {0, 0, 400, 400}, {0, 0, 40, 40});
  double drawn = 0;
  for (std::uint8_t v : canvas.picture().rgb) drawn += v;
  EXPECT_NEAR(drawn / canvas.picture().rgb.size(), mean / static_cast<double>(noise.rgb.size()), 0.02);
}

TEST(Figure, IsAPureFunction) {
  const Typeface face = Typeface::installed();
  const RgbPicture a = draw_figure(everything(1), face),
                   b = draw_figure(everything(1), Typeface::installed());
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.rgb, b.rgb);
  write_srgb8_image(a.width, a.height, a.rgb, test::screenshot_path("figure.png"));
  const RgbPicture large = draw_figure(everything(2), face);
  write_srgb8_image(large.width, large.height, large.rgb, test::screenshot_path("figure_2x.png"));
}

TEST(Figure, AnEmptyOneIsABlankSheet) {
  const RgbPicture blank = draw_figure({}, Typeface::installed());
  EXPECT_GT(blank.width, 0);
  EXPECT_GT(blank.height, 0);
  for (std::uint8_t v : blank.rgb) ASSERT_EQ(v, 255);
}

TEST(Typeface, MeasuresWhatItDraws) {
  const Typeface face = Typeface::installed();
  for (const char* text : {"illumination 0123", "Ω größe – 12 µm", "WAVE"}) {
    const float width = face.text_width(text, 20);
    int right = 0, count = 0;
    for (const Typeface::Glyph& g : face.glyphs(text, 20, 0, 0))
      right = std::max(right, g.x + g.width), ++count;
    EXPECT_NEAR(static_cast<float>(right), width, 3) << text;
    EXPECT_GT(count, 3);
  }
  EXPECT_FLOAT_EQ(face.text_width("0000", 15), face.text_width("1111", 15)) << "running numbers stand still";
  EXPECT_GT(face.text_width("\xff\xc3", 15), 0) << "bytes that are no UTF-8 are shown as replacements";
}

} // namespace
} // namespace candela
