// The section about pixel values: the histogram in stops, and the switch of the probe.

#include "app/panels/panel_list.h"
#include "app/ui/typed_number.h"
#include "imaging/exposure.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

// Stops from middle grey that the plot spans; a display shows about -7 to +2.5.
constexpr float kLow = -10, kHigh = 8;

struct HistogramPlot {
  ImVec2 lo, hi;
  float x(float stops) const { return lo.x + (stops - kLow) / (kHigh - kLow) * (hi.x - lo.x); }
};

/// Share of the pixels, padded to constant width.
std::string percent(std::size_t part, std::size_t whole) {
  return fmt::format("{:6.2f} %",
                     whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0);
}

/// Columns of one channel, in stops from middle grey at `grey` (log2). Heights are square roots, so that
/// small counts are visible next to large ones.
void draw_channel(ImDrawList& list, const HistogramPlot& plot, const LogHistogram& histogram,
                  LogHistogram::Channel channel, float grey, float largest, ImU32 color) {
  const auto& counts = histogram.counts[channel];
  for (std::size_t bin = 0; bin < LogHistogram::kBins; ++bin) {
    if (counts[bin] == 0) continue;
    const float start = LogHistogram::bin_start(bin) - grey, end = LogHistogram::bin_start(bin + 1) - grey;
    if (end <= kLow || start >= kHigh) continue;
    const float height = std::sqrt(static_cast<float>(counts[bin]) / largest) * (plot.hi.y - plot.lo.y);
    list.AddRectFilled(ImVec2(std::max(plot.x(start), plot.lo.x), plot.hi.y - std::max(height, 1.0f)),
                       ImVec2(std::min(plot.x(end), plot.hi.x), plot.hi.y), color);
  }
}

std::uint32_t largest_count(const LogHistogram& histogram) {
  std::uint32_t largest = 1;
  for (const auto& counts : histogram.counts) largest = std::max(largest, *std::ranges::max_element(counts));
  return largest;
}

void draw_marker(ImDrawList& list, const HistogramPlot& plot, float stops, const char* label, float unit) {
  if (!(stops > kLow && stops < kHigh)) return;
  const float x = std::round(plot.x(stops));
  list.AddLine(ImVec2(x, plot.lo.y), ImVec2(x, plot.hi.y), IM_COL32(235, 235, 235, 150), unit);
  const float width = ImGui::CalcTextSize(label).x;
  const float left = x + 4 * unit + width < plot.hi.x ? x + 4 * unit : x - 4 * unit - width;
  list.AddText(ImVec2(left, plot.lo.y + 2 * unit), IM_COL32(235, 235, 235, 200), label);
}

void draw_ticks(ImDrawList& list, const HistogramPlot& plot, float unit) {
  const ImU32 color = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  for (int stop = static_cast<int>(kLow); stop <= static_cast<int>(kHigh); stop += 2) {
    const float x = std::round(plot.x(static_cast<float>(stop)));
    list.AddLine(ImVec2(x, plot.hi.y), ImVec2(x, plot.hi.y + 3 * unit), color, unit);
    if (stop % 4 != 0) continue;
    const std::string text = stop == 0 ? "0" : fmt::format("{:+d}", stop);
    list.AddText(ImVec2(x - 0.5f * ImGui::CalcTextSize(text.c_str()).x, plot.hi.y + 4 * unit), color,
                 text.c_str());
  }
}

/// The plot, which changes the exposure when it is dragged. Without data it has the same size, so that
/// nothing below moves.
void histogram_plot(Ui& ui, ViewerState& state, const LogHistogram* histogram) {
  const float unit = ui.scale(), height = 96 * unit;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::InvisibleButton("##histogram", ImVec2(width, height + 6 * unit + ImGui::GetTextLineHeight()));
  ui.record("histogram.plot");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const HistogramPlot plot{at, ImVec2(at.x + width, at.y + height)};
  list.AddRectFilled(plot.lo, plot.hi, IM_COL32(18, 18, 18, 255));
  const bool exposed =
      state.picture && !state.picture->transform.false_color && state.picture->frame->view == View::radiance;
  if (!histogram || !exposed) {
    const char* why = histogram ? "This view has no exposure" : "No picture yet";
    list.AddText(ImVec2(plot.lo.x + 8 * unit, plot.lo.y + 6 * unit),
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), why);
    return;
  }
  ui.tooltip(
      "Pixels by luminance (grey), red, green and blue, in stops from middle grey as exposed; heights are "
      "square roots of counts.\nDrag to expose; double-click resets.");
  float& exposure = state.document.settings.display.exposure;
  const float before = exposure;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) exposure = 0;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0))
    exposure = std::clamp(exposure + ImGui::GetIO().MouseDelta.x / width * (kHigh - kLow), -20.0f, 20.0f);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  state.edited |= exposure != before;

  const DisplayTransform& shown = state.picture->transform;
  // The picture may not have been tone mapped again yet: add the exposure change since then.
  const float stops = shown.tone.exposure + exposure - state.picture->display.exposure;
  const float grey = std::log2(kMiddleGrey) - stops;
  const auto largest = static_cast<float>(largest_count(*histogram));
  draw_channel(list, plot, *histogram, LogHistogram::gray, grey, largest, IM_COL32(150, 150, 150, 150));
  draw_channel(list, plot, *histogram, LogHistogram::red, grey, largest, IM_COL32(230, 60, 50, 90));
  draw_channel(list, plot, *histogram, LogHistogram::green, grey, largest, IM_COL32(60, 200, 70, 90));
  draw_channel(list, plot, *histogram, LogHistogram::blue, grey, largest, IM_COL32(70, 110, 255, 110));
  draw_marker(list, plot, 0, "grey", unit);
  DisplaySettings unexposed = shown.tone;
  unexposed.exposure = 0;
  draw_marker(list, plot, std::log2(white_level(unexposed) / kMiddleGrey), "white", unit);
  draw_ticks(list, plot, unit);
}

} // namespace

void inspect_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.inspect", "Probe and histogram", false)) return;
  InspectState& inspect = state.inspect;
  static constexpr FieldInfo kProbe{
      "inspect.probe",
      FieldType::boolean,
      0,
      0,
      "",
      "The values of the pixel under the mouse and what is seen there (I; H holds it)",
      Invalidates::nothing};
  const bool initial = false;
  ui.field("inspect.probe", kProbe, &inspect.probe_visible, {&initial, "pixel probe (I)", 0});
  inspect.histogram_open = true;
  const LogHistogram* histogram = inspect.histogram.get();
  histogram_plot(ui, state, histogram);
  auto row = [&](const char* label, const std::string& value, const char* help) {
    ui.readout(label, histogram ? value : "-", help);
  };
  static const LogHistogram kEmpty;
  const LogHistogram& h = histogram ? *histogram : kEmpty;
  row("black", percent(h.clipped_black, h.pixels), "Pixels shown as 0 0 0");
  row("clipped", percent(h.clipped_white, h.pixels), "Pixels of which a channel is shown as 255");
  row("luminance",
      fmt::format("{} to {}", plain_number(static_cast<double>(h.smallest), 4),
                  plain_number(static_cast<double>(h.largest), 4)),
      "The smallest above 0, and the largest");
  row("log-average", plain_number(h.log_average, 4), "Geometric mean of the luminances above 0");
}

} // namespace candela
