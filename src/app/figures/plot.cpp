#include "app/figures/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

constexpr Rgb8 kOkabeIto[] = {{0, 114, 178},  {213, 94, 0},  {0, 158, 115},  {204, 121, 167},
                              {86, 180, 233}, {230, 159, 0}, {120, 120, 120}};

constexpr double kLogMargin = 1.2;
constexpr double kLinearMargin = 0.05;

bool shown(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

bool shown(const Plot& plot, PlotPoint p) {
  return shown(p.x, plot.x.logarithmic) && shown(p.y, plot.y.logarithmic);
}

PlotScale scale_of(const Plot& plot, const PlotAxis& axis, double PlotPoint::*coordinate) {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const PlotSeries& series : plot.series) {
    if (series.guide) continue;
    for (const PlotPoint& p : series.points) {
      if (!shown(plot, p)) continue;
      lo = std::min(lo, p.*coordinate);
      hi = std::max(hi, p.*coordinate);
    }
  }
  if (!(lo <= hi)) return axis.logarithmic ? PlotScale{1, 10, true} : PlotScale{0, 1, false};
  if (axis.logarithmic) return {lo / kLogMargin, hi * kLogMargin, true};
  if (axis.from_zero && lo >= 0 && hi > 0) return {0, hi * (1 + kLinearMargin), false};
  const double margin = hi > lo ? kLinearMargin * (hi - lo) : std::max(std::abs(lo), 1.0) * 0.5;
  return {lo - margin, hi + margin, false};
}

/// Multiples of a 1-2-5 step.
std::vector<PlotTick> linear_ticks(double lo, double hi, int most) {
  const double rough = (hi - lo) / most;
  double step = std::pow(10, std::floor(std::log10(rough)));
  for (double factor : {1.0, 2.0, 5.0, 10.0})
    if (factor * step >= rough) {
      step *= factor;
      break;
    }
  std::vector<PlotTick> out;
  for (double i = std::ceil(lo / step); i * step <= hi && static_cast<int>(out.size()) < most; ++i)
    out.push_back({i * step, plot_number(i * step)});
  return out;
}

/// Powers of ten, each followed by its multiples; every stride-th decade.
std::vector<PlotTick> decade_ticks(double lo, double hi, int stride, std::span<const double> multiples) {
  std::vector<PlotTick> out;
  const int last = static_cast<int>(std::floor(std::log10(hi)));
  for (int e = static_cast<int>(std::floor(std::log10(lo))); e <= last; ++e) {
    if (e % stride != 0) continue;
    for (double m : multiples)
      if (const double v = m * std::pow(10, e); v >= lo && v <= hi) out.push_back({v, plot_number(v)});
  }
  return out;
}

} // namespace

Rgb8 plot_color(std::size_t index, bool dark_ground) {
  Rgb8 color = kOkabeIto[index % std::size(kOkabeIto)];
  if (dark_ground)
    for (auto& c : color) c = static_cast<std::uint8_t>(c + (255 - c) / 4);
  return color;
}

double PlotScale::fraction(double v) const {
  return logarithmic ? std::log(v / lo) / std::log(hi / lo) : (v - lo) / (hi - lo);
}

double PlotScale::value(double f) const {
  return logarithmic ? lo * std::pow(hi / lo, f) : lo + f * (hi - lo);
}

PlotScale x_scale(const Plot& plot) { return scale_of(plot, plot.x, &PlotPoint::x); }
PlotScale y_scale(const Plot& plot) { return scale_of(plot, plot.y, &PlotPoint::y); }

std::vector<PlotTick> ticks(const PlotScale& scale, int most) {
  most = std::max(most, 2);
  if (!scale.logarithmic) return linear_ticks(scale.lo, scale.hi, most);
  constexpr double kFine[] = {1, 2, 5}, kDecades[] = {1};
  auto fits = [&](const std::vector<PlotTick>& t) {
    return t.size() >= 2 && static_cast<int>(t.size()) <= most;
  };
  const auto decades = decade_ticks(scale.lo, scale.hi, 1, kDecades);
  if (decades.size() < 3) {
    if (auto fine = decade_ticks(scale.lo, scale.hi, 1, kFine); fits(fine)) return fine;
    if (decades.size() < 2) return linear_ticks(scale.lo, scale.hi, most);
  }
  for (int stride = 1;; ++stride)
    if (auto coarse = decade_ticks(scale.lo, scale.hi, stride, kDecades);
        static_cast<int>(coarse.size()) <= most)
      return coarse;
}

std::string plot_number(double value) {
  if (value != 0 && (std::abs(value) < 1e-4 || std::abs(value) >= 1e6)) {
    // Write "1e-05" as "1e-5".
    std::string text = fmt::format("{:.3g}", value);
    const auto e = text.find('e');
    if (e == std::string::npos) return text;
    return fmt::format("{}e{}", text.substr(0, e), std::stoi(text.substr(e + 1)));
  }
  // fmt's g would write 1e+05 for 100000.
  std::string text = fmt::format(
      "{:.{}f}", value,
      value == 0 ? 0 : std::clamp(3 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 8));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

PlotSeries inverse_guide(const Plot& plot, std::string label) {
  PlotSeries guide{std::move(label), {}, true};
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& p : series.points) {
      if (series.guide || !shown(plot, p) || p.x == 0) continue;
      const PlotScale x = x_scale(plot);
      constexpr int kSteps = 32; // a curve on linear axes
      for (int i = 0; i <= kSteps; ++i) {
        const double at = x.value(static_cast<double>(i) / kSteps);
        if (at != 0) guide.points.push_back({at, p.y * p.x / at});
      }
      return guide;
    }
  return guide;
}

vec2 PlotFrame::position(PlotPoint p) const {
  // Clamped far outside, so that screen coordinates stay finite.
  auto within = [](double f) { return static_cast<float>(std::clamp(f, -4.0, 5.0)); };
  return {lo.x + within(x.fraction(p.x)) * (hi.x - lo.x), hi.y - within(y.fraction(p.y)) * (hi.y - lo.y)};
}

std::vector<std::pair<vec2, vec2>> strokes_of(std::span<const vec2> points, float dash) {
  std::vector<std::pair<vec2, vec2>> out;
  float walked = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const vec2 a = points[i], b = points[i + 1];
    const float length = glm::length(b - a);
    if (dash <= 0) {
      out.emplace_back(a, b);
      continue;
    }
    for (float at = 0; at < length;) {
      const float phase = std::fmod(walked + at, 2 * dash);
      const float step = std::min((phase < dash ? dash : 2 * dash) - phase + 1e-3f, length - at);
      if (phase < dash) out.emplace_back(glm::mix(a, b, at / length), glm::mix(a, b, (at + step) / length));
      at += step;
    }
    walked += length;
  }
  return out;
}

std::string fitted_text(const PlotPainter& painter, std::string_view text, float room) {
  if (painter.text_width(text) <= room) return std::string(text);
  while (!text.empty()) {
    std::size_t end = text.size() - 1; // whole characters: continuation bytes are 10xxxxxx
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    text = text.substr(0, end);
    std::string shorter = std::string(text) + "…";
    if (painter.text_width(shorter) <= room) return shorter;
  }
  return {};
}

namespace {

struct Colors {
  Rgb8 text, dim, frame, grid, ground;
};
constexpr Colors kLight{{30, 30, 30}, {95, 95, 95}, {120, 120, 120}, {226, 226, 226}, {255, 255, 255}};
constexpr Colors kDark{{222, 222, 222}, {150, 150, 150}, {110, 110, 110}, {58, 58, 58}, {30, 30, 30}};

struct Layout {
  const Plot& plot;
  const PlotTheme& theme;
  const Colors& colors;
  PlotPainter& painter;
  PlotFrame frame;

  float text_height() const { return painter.text_height(); }

  std::vector<vec2> line_of(const PlotSeries& series) const {
    std::vector<vec2> line;
    for (const PlotPoint& p : series.points)
      if (shown(plot, p)) line.push_back(frame.position(p));
    return line;
  }

  void axes(vec2 lo, vec2 hi);
  void lines();
  void legend();
};

/// Fits the area between the labels, then draws frame, grid and labels.
void Layout::axes(vec2 lo, vec2 hi) {
  const float u = theme.unit, line = text_height(), pad = 4 * u;
  float top = lo.y;
  if (!plot.title.empty()) {
    painter.text({lo.x, top}, fitted_text(painter, plot.title, hi.x - lo.x), colors.text);
    top += line + pad;
  }
  // The label of y is above its axis, so that it need not be rotated.
  painter.text({lo.x, top}, fitted_text(painter, plot.y.label, hi.x - lo.x), colors.dim);
  top += line + pad;
  const float bottom = hi.y - 2 * line - 2 * pad;
  const auto y_ticks = ticks(frame.y, static_cast<int>((bottom - top) / (1.8f * line)));
  float widest = 0;
  for (const PlotTick& t : y_ticks) widest = std::max(widest, painter.text_width(t.text));
  frame.lo = {lo.x + widest + 2 * pad, top + 0.5f * line};
  frame.hi = {hi.x - 2 * pad, std::max(bottom, frame.lo.y + 1)};
  frame.hi.x = std::max(frame.hi.x, frame.lo.x + 1);

  for (const PlotTick& t : y_ticks) {
    const float y = std::round(frame.position({frame.x.lo, t.value}).y);
    const vec2 rule[] = {{frame.lo.x, y}, {frame.hi.x, y}};
    painter.line(rule, colors.grid, u, false);
    painter.text({frame.lo.x - 2 * pad - painter.text_width(t.text) + pad, y - 0.5f * line}, t.text,
                 colors.dim);
  }
  const float room = painter.text_width("0.0005") + 3 * pad;
  const auto x_ticks = ticks(frame.x, static_cast<int>((frame.hi.x - frame.lo.x) / room));
  float free_from = lo.x;
  for (const PlotTick& t : x_ticks) {
    const float x = std::round(frame.position({t.value, frame.y.lo}).x), width = painter.text_width(t.text);
    const vec2 rule[] = {{x, frame.lo.y}, {x, frame.hi.y}};
    painter.line(rule, colors.grid, u, false);
    const float left = std::clamp(x - 0.5f * width, lo.x, std::max(lo.x, hi.x - width));
    if (left < free_from) continue; // no room for its number
    painter.text({left, frame.hi.y + pad}, t.text, colors.dim);
    free_from = left + width + pad;
  }
  const std::string label = fitted_text(painter, plot.x.label, hi.x - lo.x);
  painter.text({frame.hi.x - painter.text_width(label), frame.hi.y + line + 2 * pad}, label, colors.dim);
  const vec2 border[] = {{frame.lo.x, frame.lo.y}, {frame.lo.x, frame.hi.y}, {frame.hi.x, frame.hi.y}};
  painter.line(border, colors.frame, u, false);
}

void Layout::lines() {
  const float u = theme.unit;
  painter.clip(frame.lo - 3 * u, frame.hi + 3 * u);
  std::size_t index = 0;
  for (const PlotSeries& series : plot.series)
    if (series.guide) painter.line(line_of(series), colors.dim, u, true);
  for (const PlotSeries& series : plot.series) {
    if (series.guide) continue;
    const Rgb8 color = plot_color(index++, theme.dark);
    const std::vector<vec2> line = line_of(series);
    painter.line(line, color, 2 * u, false);
    constexpr std::size_t kMostDots = 24; // more would hide the line
    if (line.size() <= kMostDots)
      for (vec2 p : line) painter.dot(p, 3 * u, color);
  }
}

void Layout::legend() {
  const float u = theme.unit, line = text_height(), pad = 6 * u, sample = 18 * u;
  const vec2 area = frame.hi - frame.lo;
  std::vector<std::string> labels;
  float widest = 0;
  for (const PlotSeries& series : plot.series) {
    labels.push_back(fitted_text(painter, series.label, 0.6f * area.x - sample - 3 * pad));
    widest = std::max(widest, painter.text_width(labels.back()));
  }
  const vec2 size(sample + 3 * pad + widest, static_cast<float>(labels.size()) * (line + 2 * u) + pad);
  if (labels.empty() || size.y > area.y) return;
  // The corner where it covers the fewest points, preferably the upper right: errors fall to the right.
  const vec2 corners[] = {{frame.hi.x - size.x - pad, frame.lo.y + pad},
                          frame.lo + pad,
                          frame.hi - size - pad,
                          {frame.lo.x + pad, frame.hi.y - size.y - pad}};
  vec2 best = corners[0];
  std::size_t fewest = ~std::size_t{0};
  for (vec2 corner : corners) {
    std::size_t covered = 0;
    for (const PlotSeries& series : plot.series) {
      const std::vector<vec2> points = line_of(series);
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (int k = 0; k <= 8; ++k) {
          const vec2 p = glm::mix(points[i], points[i + 1], static_cast<float>(k) / 8) - corner;
          covered += p.x > 0 && p.y > 0 && p.x < size.x && p.y < size.y;
        }
    }
    if (covered < fewest) fewest = covered, best = corner;
  }
  painter.fill(best, best + size, colors.ground);
  std::size_t index = 0;
  vec2 at = best + vec2(pad, 0.5f * pad);
  for (std::size_t i = 0; i < labels.size(); ++i, at.y += line + 2 * u) {
    const bool guide = plot.series[i].guide;
    const Rgb8 color = guide ? colors.dim : plot_color(index++, theme.dark);
    const float y = at.y + 0.5f * line;
    const vec2 stroke[] = {{at.x, y}, {at.x + sample, y}};
    painter.line(stroke, color, guide ? u : 2 * u, guide);
    painter.text({at.x + sample + pad, at.y}, labels[i], colors.text);
  }
}

} // namespace

PlotFrame draw_plot(const Plot& plot, vec2 lo, vec2 hi, const PlotTheme& theme, PlotPainter& painter) {
  Layout layout{plot, theme, theme.dark ? kDark : kLight, painter, {}};
  layout.frame.x = x_scale(plot);
  layout.frame.y = y_scale(plot);
  painter.clip(lo, hi);
  painter.fill(lo, hi, layout.colors.ground);
  layout.axes(lo, hi);
  layout.lines();
  painter.clip(lo, hi);
  layout.legend();
  return layout.frame;
}

} // namespace candela
