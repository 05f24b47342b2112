#include "app/figures/figure.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

// Lengths at scale 1, pixels.
constexpr float kFigureTitle = 20, kPanelTitle = 16, kCaption = 14;
constexpr float kMargin = 14, kGap = 14, kSmallGap = 6;
constexpr float kLeastPanel = 190; // narrower panels could not hold their captions
constexpr float kDefaultPlotWidth = 440, kDefaultPlotHeight = 320; // without a picture that sets the size
constexpr float kBarHeight = 12;
constexpr Rgb8 kGround{255, 255, 255}, kText{25, 25, 25}, kDim{80, 80, 80};

/// Breaks a text at spaces into lines no wider than `room`; breaks longer words anywhere.
std::vector<std::string> broken_lines(const Typeface& face, std::string_view text, float size, float room) {
  std::vector<std::string> lines;
  std::string line;
  auto fits = [&](const std::string& t) { return face.text_width(t, size) <= room; };
  auto add_word = [&](std::string word) {
    const std::string longer = line.empty() ? word : line + " " + word;
    if (fits(longer)) {
      line = longer;
      return;
    }
    if (!line.empty()) lines.push_back(std::move(line));
    line.clear();
    while (!fits(word)) {
      std::size_t end = word.size();
      do {
        --end;
        while (end > 1 && (static_cast<unsigned char>(word[end]) & 0xc0) == 0x80) --end;
      } while (end > 1 && !fits(word.substr(0, end)));
      end = std::max<std::size_t>(end, 1);
      if (end >= word.size()) break; // a single character
      lines.push_back(word.substr(0, end));
      word.erase(0, end);
    }
    line = word;
  };
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    if (space > 0) add_word(std::string(text.substr(0, space)));
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

int whole(float x) { return static_cast<int>(std::lround(x)); }

/// Lays out the grid row by row from the top; corresponding parts of a row's panels are aligned.
class Arranger {
public:
  Arranger(const Figure& figure, const Typeface& face) : figure_(figure), face_(face) {}

  FigureLayout run() {
    const std::size_t count = figure_.panels.size();
    std::size_t narrow = 0; // number of panels that share rows
    for (const FigurePanel& panel : figure_.panels) narrow += !panel.whole_row;
    narrow = std::max<std::size_t>(narrow, 1);
    columns_ = figure_.columns > 0 ? std::min(static_cast<std::size_t>(figure_.columns), narrow) : narrow;
    widths_.assign(columns_, px(kLeastPanel));
    std::vector<std::pair<std::size_t, std::size_t>> rows;
    int widest = 0;
    for (std::size_t i = 0; i < count;) {
      const std::size_t first = i;
      if (figure_.panels[i].whole_row) {
        widest = std::max(widest, content_size(i++).x);
      } else {
        for (; i < count && i - first < columns_ && !figure_.panels[i].whole_row; ++i)
          widths_[i - first] = std::max(widths_[i - first], content_size(i).x);
      }
      rows.emplace_back(first, i);
    }
    const int margin = px(kMargin), gap = px(kGap);
    int right = margin - gap;
    for (int width : widths_) {
      lefts_.push_back(right + gap);
      right += gap + width;
    }
    layout_.width = std::max(right, margin + widest) + margin;
    y_ = margin;
    if (!figure_.title.empty()) {
      text(FigureItem::Kind::title, 0, figure_.title, kFigureTitle,
           {margin, y_, layout_.width - 2 * margin, 0});
      y_ = bottom_ + px(kSmallGap);
    }
    for (auto [first, last] : rows) row(first, last);
    layout_.height = std::max(y_ - gap, margin) + margin;
    return std::move(layout_);
  }

private:
  int px(float length) const { return whole(length * figure_.scale); }

  ivec2 picture_size(const RgbPicture& p) const {
    if (figure_.picture_width <= 0 || p.width <= 0) return {p.width, p.height};
    if (p.width <= figure_.picture_width) return figure_.picture_width / p.width * ivec2(p.width, p.height);
    const double shrink = static_cast<double>(figure_.picture_width) / p.width;
    return {figure_.picture_width, std::max(1, static_cast<int>(std::lround(shrink * p.height)))};
  }

  /// Size of the picture, or of a plot.
  ivec2 content_size(std::size_t panel) const {
    const FigurePanel& p = figure_.panels[panel];
    if (!p.plot) return picture_size(p.picture);
    ivec2 size(px(kDefaultPlotWidth), px(kDefaultPlotHeight));
    for (const FigurePanel& other : figure_.panels)
      if (!other.plot) size = glm::max(size, ivec2(picture_size(other.picture).x, 0));
    return size;
  }

  void text(FigureItem::Kind kind, std::size_t panel, std::string_view words, float size, Box room) {
    const float pixels = size * figure_.scale;
    const int line = whole(1.25f * pixels);
    bottom_ = room.y;
    for (std::string& t : broken_lines(face_, words, pixels, static_cast<float>(room.width))) {
      const int width = static_cast<int>(std::ceil(face_.text_width(t, pixels)));
      layout_.items.push_back({kind, panel, 0, {room.x, bottom_, width, line}, std::move(t), pixels});
      bottom_ += line;
    }
  }

  void row(std::size_t first, std::size_t last) {
    auto left = [&](std::size_t i) { return lefts_[i - first]; };
    auto width = [&](std::size_t i) {
      return figure_.panels[i].whole_row ? layout_.width - 2 * px(kMargin) : widths_[i - first];
    };
    const int gap = px(kGap), small = px(kSmallGap);
    int lowest = y_;
    for (std::size_t i = first; i < last; ++i) {
      text(FigureItem::Kind::panel_title, i, figure_.panels[i].title, kPanelTitle,
           {left(i), y_, width(i), 0});
      lowest = std::max(lowest, bottom_);
    }
    y_ = lowest + (lowest > y_ ? small / 2 : 0);

    // Pictures and their details determine the height; plots fill it.
    int height = 0;
    for (std::size_t i = first; i < last; ++i)
      if (!figure_.panels[i].plot)
        height = std::max(height, picture_size(figure_.panels[i].picture).y + details_height(i));
    for (std::size_t i = first; i < last; ++i)
      if (figure_.panels[i].plot) height = std::max(height, content_size(i).y);
    for (std::size_t i = first; i < last; ++i) {
      const FigurePanel& panel = figure_.panels[i];
      if (panel.plot) {
        layout_.items.push_back({FigureItem::Kind::plot, i, 0, {left(i), y_, width(i), height}, {}, 0});
        continue;
      }
      const ivec2 size = picture_size(panel.picture);
      if (size.x <= 0) continue; // an empty cell
      layout_.items.push_back({FigureItem::Kind::picture, i, 0, {left(i), y_, size.x, size.y}, {}, 0});
      details(i, {left(i), y_ + size.y + small});
    }
    y_ += height;

    lowest = y_;
    for (std::size_t i = first; i < last; ++i) {
      if (!figure_.panels[i].bar) continue;
      const int bar = px(kBarHeight + 2 * 1.25f * kCaption);
      const int bar_width = figure_.panels[i].plot ? width(i) : picture_size(figure_.panels[i].picture).x;
      layout_.items.push_back({FigureItem::Kind::bar,
                               i,
                               0,
                               {left(i), y_ + small, std::max(bar_width, px(kLeastPanel)), bar},
                               {},
                               0});
      lowest = std::max(lowest, y_ + small + bar);
    }
    for (std::size_t i = first; i < last; ++i) {
      int top = (figure_.panels[i].bar ? y_ + small + px(kBarHeight + 2 * 1.25f * kCaption) : y_) + small;
      for (const std::string& line : figure_.panels[i].caption) {
        text(FigureItem::Kind::caption, i, line, kCaption, {left(i), top, width(i), 0});
        lowest = std::max(lowest, top = bottom_);
      }
    }
    y_ = lowest + gap;
  }

  /// Width of each of the details under a picture.
  int detail_width(std::size_t panel) const {
    const int n = static_cast<int>(figure_.details.size());
    return (picture_size(figure_.panels[panel].picture).x - (n - 1) * px(kSmallGap)) / n;
  }

  int detail_height(std::size_t panel, const Box& part) const {
    return std::max(1, whole(static_cast<float>(detail_width(panel)) * static_cast<float>(part.height) /
                             static_cast<float>(part.width)));
  }

  int details_height(std::size_t panel) const {
    if (figure_.details.empty() || figure_.panels[panel].picture.width <= 0) return 0;
    int tallest = 0;
    for (const Box& part : figure_.details) tallest = std::max(tallest, detail_height(panel, part));
    return px(kSmallGap) + tallest;
  }

  void details(std::size_t panel, ivec2 at) {
    for (std::size_t k = 0; k < figure_.details.size(); ++k) {
      const Box box{at.x, at.y, detail_width(panel), detail_height(panel, figure_.details[k])};
      layout_.items.push_back({FigureItem::Kind::detail, panel, k, box, {}, 0});
      at.x += box.width + px(kSmallGap);
    }
  }

  const Figure& figure_;
  const Typeface& face_;
  FigureLayout layout_;
  std::size_t columns_ = 1;
  std::vector<int> widths_, lefts_;
  int y_ = 0;
  int bottom_ = 0; ///< of the last text
};

class CanvasPainter : public PlotPainter {
public:
  CanvasPainter(Canvas& canvas, const Typeface& face, float size)
      : canvas_(canvas), face_(face), size_(size) {}
  float text_width(std::string_view t) const override { return face_.text_width(t, size_); }
  float text_height() const override { return size_; }
  void text(vec2 at, std::string_view t, Rgb8 color) override { canvas_.text(face_, t, size_, at, color); }
  void fill(vec2 lo, vec2 hi, Rgb8 color) override { canvas_.fill(box(lo, hi), color); }
  void line(std::span<const vec2> points, Rgb8 color, float width, bool dashed) override {
    canvas_.line(points, width, color, dashed);
  }
  void dot(vec2 center, float radius, Rgb8 color) override { canvas_.dot(center, radius, color); }
  void clip(vec2 lo, vec2 hi) override { canvas_.clip(box(lo, hi)); }

private:
  static Box box(vec2 lo, vec2 hi) {
    return {whole(lo.x), whole(lo.y), whole(hi.x) - whole(lo.x), whole(hi.y) - whole(lo.y)};
  }
  Canvas& canvas_;
  const Typeface& face_;
  float size_;
};

void draw_bar(Canvas& canvas, const Typeface& face, const ColorBar& bar, const Box& box, float scale) {
  const int height = whole(kBarHeight * scale);
  for (int x = 0; x < box.width; ++x) {
    const auto i = static_cast<std::size_t>(x) * bar.colors.size() / static_cast<std::size_t>(box.width);
    canvas.fill({box.x + x, box.y, 1, height}, bar.colors[i]);
  }
  const float size = kCaption * scale, line = 1.25f * size;
  const auto left = static_cast<float>(box.x), width = static_cast<float>(box.width);
  const float top = static_cast<float>(box.y + height) + 0.1f * size;
  float free_from = left;
  for (const PlotTick& t : ticks(bar.scale, std::max(2, static_cast<int>(width / (5 * size))))) {
    const float x = left + width * static_cast<float>(bar.scale.fraction(t.value));
    const float text = face.text_width(t.text, size);
    const float at = std::clamp(x - 0.5f * text, left, left + width - text);
    if (at < free_from) continue;
    canvas.fill({std::clamp(whole(x), box.x, box.x + box.width - 1), box.y + height - whole(3 * scale),
                 std::max(1, whole(scale)), whole(3 * scale)},
                kGround);
    canvas.text(face, t.text, size, {at, top}, kDim);
    free_from = at + text + 0.5f * size;
  }
  const std::string label = broken_lines(face, bar.label, size, width).empty()
                                ? std::string()
                                : broken_lines(face, bar.label, size, width).front();
  canvas.text(face, label, size, {left, top + line}, kDim);
}

} // namespace

ColorBar color_bar(ColorMap map, const PlotScale& scale, std::string label) {
  ColorBar bar{{}, scale, std::move(label)};
  for (int i = 0; i < 256; ++i) bar.colors.push_back(map_color(map, static_cast<float>(i) / 255));
  return bar;
}

// Light, saturated colours that are visible on dark and bright pictures.
Rgb8 detail_color(std::size_t index) {
  constexpr Rgb8 kColors[] = {{230, 159, 0}, {86, 180, 233}, {0, 190, 130}, {204, 121, 167}};
  return kColors[index % std::size(kColors)];
}

FigureLayout layout_figure(const Figure& figure, const Typeface& face) {
  return Arranger(figure, face).run();
}

RgbPicture draw_figure(const Figure& figure, const Typeface& face) {
  const FigureLayout layout = layout_figure(figure, face);
  Canvas canvas(layout.width, layout.height, kGround);
  const int thick = std::max(1, whole(2 * figure.scale));
  for (const FigureItem& item : layout.items) {
    const Box& box = item.box;
    switch (item.kind) {
    case FigureItem::Kind::title:
    case FigureItem::Kind::panel_title:
    case FigureItem::Kind::caption:
      canvas.text(face, item.text, item.text_size, vec2(box.x, box.y),
                  item.kind == FigureItem::Kind::caption ? kDim : kText);
      break;
    case FigureItem::Kind::picture: {
      const RgbPicture& picture = figure.panels[item.panel].picture;
      canvas.draw(picture, {0, 0, picture.width, picture.height}, box);
      const double zoom = static_cast<double>(box.width) / picture.width;
      auto scaled = [&](int v) { return static_cast<int>(std::lround(zoom * v)); };
      for (std::size_t k = 0; k < figure.details.size(); ++k) {
        const Box& part = figure.details[k];
        canvas.clip(box);
        canvas.frame(
            {box.x + scaled(part.x), box.y + scaled(part.y), scaled(part.width), scaled(part.height)}, thick,
            detail_color(k));
        canvas.clip({0, 0, layout.width, layout.height});
      }
      break;
    }
    case FigureItem::Kind::detail:
      canvas.draw(figure.panels[item.panel].picture, figure.details[item.detail], box);
      canvas.frame(box, thick, detail_color(item.detail));
      break;
    case FigureItem::Kind::plot: {
      CanvasPainter painter(canvas, face, kCaption * figure.scale);
      draw_plot(*figure.panels[item.panel].plot, vec2(box.x, box.y),
                vec2(box.x + box.width, box.y + box.height), {figure.scale, false}, painter);
      canvas.clip({0, 0, layout.width, layout.height});
      break;
    }
    case FigureItem::Kind::bar:
      draw_bar(canvas, face, *figure.panels[item.panel].bar, box, figure.scale);
      break;
    }
  }
  return canvas.picture();
}

} // namespace candela
