#include "app/ui/plot_widget.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

ImU32 color_of(Rgb8 c) { return IM_COL32(c[0], c[1], c[2], 255); }
ImVec2 to_im(vec2 v) { return {v.x, v.y}; }

class ImguiPainter : public PlotPainter {
public:
  explicit ImguiPainter(ImDrawList& list) : list_(list) {}
  ~ImguiPainter() override {
    if (clipped_) list_.PopClipRect();
  }
  ImguiPainter(const ImguiPainter&) = delete;
  ImguiPainter& operator=(const ImguiPainter&) = delete;

  float text_width(std::string_view t) const override {
    return ImGui::CalcTextSize(t.data(), t.data() + t.size()).x;
  }
  float text_height() const override { return ImGui::GetTextLineHeight(); }
  void text(vec2 at, std::string_view t, Rgb8 color) override {
    list_.AddText(to_im(glm::round(at)), color_of(color), t.data(), t.data() + t.size());
  }
  void fill(vec2 lo, vec2 hi, Rgb8 color) override {
    list_.AddRectFilled(to_im(lo), to_im(hi), color_of(color));
  }
  void line(std::span<const vec2> points, Rgb8 color, float width, bool dashed) override {
    std::vector<ImVec2> line;
    for (vec2 p : points) line.push_back(to_im(p + 0.5f));
    if (!dashed) {
      list_.AddPolyline(line.data(), static_cast<int>(line.size()), color_of(color), 0, width);
      return;
    }
    for (auto [a, b] : strokes_of(points, 4 * std::max(width, 1.0f)))
      list_.AddLine(to_im(a + 0.5f), to_im(b + 0.5f), color_of(color), width);
  }
  void dot(vec2 center, float radius, Rgb8 color) override {
    list_.AddCircleFilled(to_im(center + 0.5f), radius, color_of(color));
  }
  void clip(vec2 lo, vec2 hi) override {
    if (clipped_) list_.PopClipRect();
    list_.PushClipRect(to_im(lo), to_im(hi), true);
    clipped_ = true;
  }

private:
  ImDrawList& list_;
  bool clipped_ = false;
};

/// The point whose x is nearest.
const PlotPoint* nearest_point(const Plot& plot, const PlotSeries& series, double x) {
  const PlotPoint* best = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlotPoint& p : series.points) {
    const double distance = plot.x.logarithmic ? std::abs(std::log(p.x / x)) : std::abs(p.x - x);
    if (distance < nearest && std::isfinite(p.y)) nearest = distance, best = &p;
  }
  return best;
}

} // namespace

std::string plot_readout(const Plot& plot, const PlotSeries& series, double x) {
  const PlotPoint* p = nearest_point(plot, series, x);
  return p == nullptr ? std::string()
                      : fmt::format("{}: {} at {}", series.label, plot_number(p->y), plot_number(p->x));
}

void plot_widget(Ui& ui, const char* name, const Plot& plot, float height) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 1.0f), height * ui.scale());
  ImGui::Dummy(size);
  ui.record(name);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  PlotFrame frame;
  {
    ImguiPainter painter(list);
    frame =
        draw_plot(plot, vec2(lo.x, lo.y), vec2(lo.x + size.x, lo.y + size.y), {ui.scale(), true}, painter);
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!hovered || mouse.x < frame.lo.x || mouse.x > frame.hi.x) return;
  const double x = frame.x.value(static_cast<double>((mouse.x - frame.lo.x) / (frame.hi.x - frame.lo.x)));
  list.AddLine({mouse.x, frame.lo.y}, {mouse.x, frame.hi.y}, IM_COL32(255, 255, 255, 90), ui.scale());
  std::string text;
  for (const PlotSeries& series : plot.series) {
    if (series.guide) continue;
    if (std::string line = plot_readout(plot, series, x); !line.empty())
      text += (text.empty() ? "" : "\n") + line;
  }
  ui.tooltip(text);
}

} // namespace candela
