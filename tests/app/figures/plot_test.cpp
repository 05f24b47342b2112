#include "app/ui/plot_widget.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

/// Writes down what is drawn; every letter is 7 pixels wide.
class Recorder : public PlotPainter {
public:
  struct Text {
    vec2 lo, hi;
    std::string text;
  };
  std::vector<Text> texts;
  std::vector<std::vector<vec2>> thick_lines;
  float text_width(std::string_view t) const override { return 7 * static_cast<float>(t.size()); }
  float text_height() const override { return 14; }
  void text(vec2 at, std::string_view t, Rgb8) override {
    texts.push_back({at, at + vec2(text_width(t), text_height()), std::string(t)});
  }
  void fill(vec2, vec2, Rgb8) override {}
  void line(std::span<const vec2> points, Rgb8, float width, bool) override {
    if (width > 1) thick_lines.emplace_back(points.begin(), points.end());
  }
  void dot(vec2, float, Rgb8) override {}
  void clip(vec2, vec2) override {}
};

Plot falling(double from, double to, double exponent) {
  Plot plot{"Convergence", {"samples a pixel", true}, {"relMSE", true}, {{"Sobol'", {}, false}}};
  for (double n = from; n <= to; n *= 2) plot.series[0].points.push_back({n, std::pow(n, exponent)});
  return plot;
}

TEST(Plot, TicksAreFewRoundAndInside) {
  const PlotScale scales[] = {{1, 1000, true},     {0.8, 1.3, true}, {3e-7, 2e4, true},   {2, 9, true},
                              {1e-30, 1e30, true}, {0, 1, false},    {-3.7, 12.1, false}, {999, 1001, false}};
  for (const PlotScale& scale : scales)
    for (int most : {2, 3, 5, 8, 20}) {
      const auto t = ticks(scale, most);
      EXPECT_GE(t.size(), 1u) << scale.lo << ' ' << scale.hi << ' ' << most;
      EXPECT_LE(static_cast<int>(t.size()), most) << scale.lo << ' ' << scale.hi << ' ' << most;
      for (std::size_t i = 0; i < t.size(); ++i) {
        EXPECT_GE(scale.fraction(t[i].value), -1e-9);
        EXPECT_LE(scale.fraction(t[i].value), 1 + 1e-9);
        EXPECT_NEAR(std::stod(t[i].text), t[i].value, 1e-3 * std::abs(t[i].value) + 1e-12);
        if (i > 0) { EXPECT_GT(t[i].value, t[i - 1].value); }
      }
    }
  const auto decades = ticks({0.9, 1200, true}, 6);
  ASSERT_EQ(decades.size(), 4u);
  EXPECT_EQ(decades[3].text, "1000");
}

TEST(Plot, NumbersAreShort) {
  EXPECT_EQ(plot_number(0), "0");
  EXPECT_EQ(plot_number(1), "1");
  EXPECT_EQ(plot_number(0.001), "0.001");
  EXPECT_EQ(plot_number(1e-5), "1e-5");
  EXPECT_EQ(plot_number(3.25e-7), "3.25e-7");
  EXPECT_EQ(plot_number(100000), "100000");
  EXPECT_EQ(plot_number(2e9), "2e9");
  EXPECT_EQ(plot_number(-12.5), "-12.5");
  EXPECT_EQ(plot_number(0.0123456), "0.01235");
}

TEST(Plot, ScaleAndItsInverse) {
  for (const PlotScale& scale : {PlotScale{0.5, 80, true}, PlotScale{-4, 9, false}}) {
    EXPECT_DOUBLE_EQ(scale.fraction(scale.lo), 0);
    EXPECT_DOUBLE_EQ(scale.fraction(scale.hi), 1);
    for (double f : {0.1, 0.5, 0.77}) EXPECT_NEAR(scale.fraction(scale.value(f)), f, 1e-12);
  }
}

TEST(Plot, TextIsInsideAndDoesNotOverlap) {
  Plot plot = falling(1, 4096, -1);
  plot.series.push_back(
      {"a series of a name so long that no legend could hold it", {{1, 2}, {900, 1e-4}}, false});
  plot.series.push_back(inverse_guide(plot, "1/N"));
  for (vec2 size : {vec2(300, 200), vec2(640, 400), vec2(220, 160)}) {
    Recorder painter;
    const vec2 lo(50, 20);
    const PlotFrame frame = draw_plot(plot, lo, lo + size, {1, false}, painter);
    EXPECT_GT(frame.hi.x - frame.lo.x, 0.5f * size.x);
    for (std::size_t i = 0; i < painter.texts.size(); ++i) {
      const auto& a = painter.texts[i];
      EXPECT_TRUE(a.lo.x >= lo.x && a.lo.y >= lo.y && a.hi.x <= lo.x + size.x && a.hi.y <= lo.y + size.y)
          << a.text << " in " << size.x << " x " << size.y;
      for (std::size_t j = 0; j < i; ++j) {
        const auto& b = painter.texts[j];
        EXPECT_TRUE(a.hi.x <= b.lo.x || b.hi.x <= a.lo.x || a.hi.y <= b.lo.y || b.hi.y <= a.lo.y)
            << a.text << " over " << b.text;
      }
    }
  }
}

TEST(Plot, LinesAreWhereTheNumbersAre) {
  const Plot plot = falling(1, 1024, -1);
  Recorder painter;
  const PlotFrame frame = draw_plot(plot, vec2(0), vec2(500, 400), {1, false}, painter);
  ASSERT_FALSE(painter.thick_lines.empty());
  const auto& line = painter.thick_lines.front();
  ASSERT_EQ(line.size(), 11u);
  for (std::size_t i = 1; i < line.size(); ++i) { // 1/N is straight on logarithmic axes
    EXPECT_NEAR(line[i].x - line[i - 1].x, line[1].x - line[0].x, 0.01);
    EXPECT_NEAR(line[i].y - line[i - 1].y, line[1].y - line[0].y, 0.01);
    EXPECT_GT(line[i].y, line[i - 1].y);
  }
  EXPECT_LT(glm::length(line.back() - frame.position({1024, 1.0 / 1024})), 0.01f);
}

TEST(Plot, WhatCannotBeShownIsLeftOut) {
  Plot plot = falling(1, 16, -1);
  plot.series[0].points.push_back({32, 0});
  plot.series[0].points.push_back({64, std::numeric_limits<double>::quiet_NaN()});
  plot.series[0].points.push_back({-1, 5});
  EXPECT_LT(x_scale(plot).hi, 30);
  Recorder painter;
  draw_plot(plot, vec2(0), vec2(400, 300), {1, true}, painter);
  EXPECT_EQ(painter.thick_lines.front().size(), 5u);
  for (const Plot& empty : {Plot{}, Plot{"t", {"x", true}, {"y", true}, {{"nothing", {}, false}}}}) {
    Recorder other;
    draw_plot(empty, vec2(0), vec2(400, 300), {1, true}, other);
    EXPECT_TRUE(inverse_guide(empty, "1/N").points.empty());
  }
}

TEST(Plot, TheGuideFallsAsOneOverN) {
  const Plot plot = falling(2, 512, -0.5);
  const PlotSeries guide = inverse_guide(plot, "1/N");
  ASSERT_GT(guide.points.size(), 2u);
  EXPECT_TRUE(guide.guide);
  for (const PlotPoint& p : guide.points)
    EXPECT_NEAR(p.x * p.y, plot.series[0].points[0].x * plot.series[0].points[0].y, 1e-9);
}

TEST(Plot, TheReadOutTellsTheNearestPoint) {
  const Plot plot = falling(1, 64, -1);
  EXPECT_EQ(plot_readout(plot, plot.series[0], 5), "Sobol': 0.25 at 4") << "nearest in ratio";
  EXPECT_EQ(plot_readout(plot, plot.series[0], 1e9), "Sobol': 0.01562 at 64");
  EXPECT_EQ(plot_readout(plot, {"none", {}, false}, 1), "");
}

TEST(Plot, TextIsCutAtWholeCharacters) {
  const Recorder painter;
  EXPECT_EQ(fitted_text(painter, "short", 100), "short");
  EXPECT_EQ(fitted_text(painter, "größte", 7 * 7), "grö…"); // ö has two bytes, an ellipsis three
  EXPECT_EQ(fitted_text(painter, "abc", 3), "");
}

} // namespace
} // namespace candela
