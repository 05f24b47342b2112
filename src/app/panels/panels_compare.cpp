// The panel of a comparison, and the labels over its pictures.

#include "app/compare/compare_layout.h"
#include "app/panels/panel_list.h"
#include "app/panels/panels.h"
#include "app/ui/plot_widget.h"
#include "imaging/difference.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace candela {

namespace {

constexpr float kPlotHeight = 210; // at scale 1
constexpr std::string_view kLayouts[] = {"side by side", "wipe", "flip", "difference"};
constexpr std::string_view kSides[] = {"A", "B"};
constexpr int kZooms[] = {0, 1, 2, 4, 8};
constexpr std::string_view kZoomNames[] = {"fit", "1:1", "2:1", "4:1", "8:1"};
constexpr float kRanges[] = {1.0f, 0.1f, 0.01f};
constexpr std::string_view kSigns[] = {"0.1 to 100 %", "-100 to 100 %", "-10 to 10 %", "-1 to 1 %"};
constexpr int kReferenceSpp[] = {64, 256, 1024, 4096, 16384};
constexpr std::string_view kReferenceSppNames[] = {"64", "256", "1024", "4096", "16384"};

template <std::size_t N, class T>
int index_of(const T (&values)[N], T value) {
  const auto found = std::ranges::find(values, value);
  return found == std::end(values) ? 0 : static_cast<int>(found - std::begin(values));
}

std::string progress_text(const CompareVariant& variant) {
  return fmt::format("{} spp, {:.1f} s", variant.status.spp, variant.status.render_seconds);
}

/// Progress with the best available error measure.
std::string variant_text(const CompareVariant& variant) {
  if (variant.rel_mse)
    return fmt::format("{}, relMSE {}", progress_text(variant), plot_number(*variant.rel_mse));
  if (variant.noise)
    return fmt::format("{}, {} {}", progress_text(variant), kNoiseName, plot_number(*variant.noise));
  return progress_text(variant);
}

void error_readout(Ui& ui, const CompareState& compare, std::optional<double> CompareVariant::*error,
                   const char* label, std::string_view tip) {
  std::string text;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<double> value = compare.variants[i].*error;
    text += fmt::format("{}{} {}", i > 0 ? ", " : "", variant_letter(static_cast<int>(i)),
                        value ? plot_number(*value) : "-");
  }
  ui.readout(label, text, tip);
}

void error_readouts(Ui& ui, const CompareState& compare) {
  if (compare.has_reference)
    error_readout(ui, compare, &CompareVariant::rel_mse, "relMSE",
                  "The mean over pixels and channels of (x - r)^2 / (r^2 + 0.01), r being the reference: "
                  "noise and bias");
  error_readout(ui, compare, &CompareVariant::noise, kNoiseName.data(),
                "The relMSE estimated from each picture's own variance: the mean over pixels and channels "
                "of variance / (mean^2 + 0.01).\nIt needs no reference, but does not include bias, such as "
                "that of clamping; relMSE does. Samplers that distribute their samples well do better "
                "than it says.");
  ui.record("compare.noise");
}

void layout_widgets(Ui& ui, CompareState& compare) {
  int layout = static_cast<int>(compare.layout);
  if (ui.choice("compare.layout", "layout", layout, kLayouts,
                "How the two pictures are shown (N).\nRestarts nothing."))
    compare.layout = static_cast<CompareLayout>(layout);
  int zoom = index_of(kZooms, compare.zoom);
  if (ui.choice("compare.zoom", "zoom", zoom, kZoomNames,
                "Screen pixels per film pixel; drag with the right button to move.\nRestarts nothing."))
    compare.zoom = kZooms[zoom];
  constexpr std::string_view kFair[] = {"samples", "time"};
  int fair = compare.equal_time ? 1 : 0;
  if (ui.choice("compare.fairness", "equal", fair, kFair,
                "Whether A and B get equal samples or equal time; the one ahead waits.\nRestarts nothing."))
    compare.equal_time = fair == 1;
  constexpr std::string_view kCameras[] = {"shared", "each its own"};
  int camera = compare.share_camera ? 0 : 1;
  if (ui.choice("compare.camera", "camera", camera, kCameras, "Whether flying moves both"))
    compare.share_camera = camera == 0;
  if (compare.layout != CompareLayout::difference) return;
  constexpr std::string_view kOf[] = {"A and B", "A and reference", "B and reference"};
  int of = static_cast<int>(compare.difference);
  if (ui.choice("compare.difference", "difference", of, kOf, "Of which pictures; relative to the second"))
    compare.difference = static_cast<DifferenceOf>(of);
  int sign = compare.with_sign ? 1 + index_of(kRanges, compare.range) : 0;
  if (ui.choice(
          "compare.range", "colours", sign, kSigns,
          "The magnitude by decades, or with its sign: blue where the first is darker, orange where it is "
          "brighter")) {
    compare.with_sign = sign > 0;
    if (sign > 0) compare.range = kRanges[sign - 1];
  }
}

void reference_widgets(Ui& ui, CompareState& compare) {
  if (!ui.subsection("compare.reference", "Reference", true)) return;
  ImGui::TextWrapped("%s", compare.reference.c_str());
  ui.record("compare.reference.text");
  int spp = index_of(kReferenceSpp, compare.reference_spp);
  if (ui.choice("compare.reference_spp", "samples", spp, kReferenceSppNames,
                "Samples a pixel of a reference to render"))
    compare.reference_spp = kReferenceSpp[spp];
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
  if (compare.rendering_reference) {
    if (ui.button("compare.cancel_reference", "Cancel", "Stops rendering the reference", third))
      compare.clear_reference_requested = true;
  } else if (ui.button("compare.render_reference", "Render",
                       "Renders A's settings with another seed, together with A and B", third)) {
    compare.render_reference_requested = true;
  }
  for (int variant = 0; variant < 2; ++variant) {
    ImGui::SameLine(0, gap);
    if (ui.button(variant == 0 ? "compare.freeze_a" : "compare.freeze_b", variant == 0 ? "Take A" : "Take B",
                  "The picture as it is now becomes the reference. It shares its noise: let it render first.",
                  third))
      compare.freeze_requested = variant;
  }
  const float load = 64 * ui.scale();
  bool open = ui.text("compare.reference_path", "file: EXR, HDR, PFM", compare.reference_path,
                      ImGui::GetContentRegionAvail().x - load - gap);
  ImGui::SameLine(0, gap);
  open |= ui.button("compare.load_reference", "Load", "Reads the picture of that file", load);
  if (open && !compare.reference_path.empty()) compare.load_reference_requested = true;
}

} // namespace

void compare_panel(Ui& ui, ViewerState& state) {
  CompareState& compare = state.compare;
  if (compare.active != compare.panel_was_active && compare.active) ImGui::SetNextItemOpen(true);
  compare.panel_was_active = compare.active;
  if (!ui.section("panel.compare", "Compare", false)) return;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  if (!compare.active) {
    ImGui::TextWrapped("Renders two settings, A and B, side by side, and measures their difference.");
    if (ui.button("compare.toggle", "Compare two settings",
                  "A keeps the settings as they are; the panels change B (C)", -1))
      compare.toggle_requested = true;
    return;
  }
  int edited = compare.edited;
  if (ui.choice("compare.edited", "panels change", edited, kSides,
                "Which variant's settings the panels show and change"))
    compare.edit_requested = edited;
  for (int variant = 0; variant < 2; ++variant) {
    const CompareVariant& s = compare.variants[static_cast<std::size_t>(variant)];
    ui.readout(variant == 0 ? "A" : "B", progress_text(s),
               s.label.empty() ? "No different settings" : s.label);
  }
  error_readouts(ui, compare);
  const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
  if (ui.button("compare.copy_a", "A to B", "B's settings become A's", third)) compare.copy_requested = 0;
  ImGui::SameLine(0, gap);
  if (ui.button("compare.copy_b", "B to A", "A's settings become B's", third)) compare.copy_requested = 1;
  ImGui::SameLine(0, gap);
  if (ui.button("compare.toggle", "Close",
                fmt::format("Continues with {} alone (C)", variant_letter(compare.edited)), third))
    compare.toggle_requested = true;
  layout_widgets(ui, compare);
  reference_widgets(ui, compare);
  constexpr std::string_view kAxes[] = {"samples", "seconds"};
  int axis = compare.over_seconds ? 1 : 0;
  if (ui.choice("compare.axis", "over", axis, kAxes, "What the plot's horizontal axis counts"))
    compare.over_seconds = axis == 1;
  plot_widget(ui, "compare.plot", compare.plot, kPlotHeight);
  if (ui.button("compare.export", "Save figure",
                "Writes both pictures, their difference and the plot as one PNG, under a new name", -1))
    compare.export_requested = true;
}

namespace {

ImVec2 corner(const PixelRect& r) { return {static_cast<float>(r.x), static_cast<float>(r.y)}; }

/// Text on a dark background with its top left corner at `at`; lines end at `right`.
void plate(Ui& ui, ImDrawList& list, ImVec2 at, float right, const std::string& text) {
  const float pad = 5 * ui.scale();
  const float room = right - at.x - 2 * pad;
  if (room < 20 * ui.scale()) return;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
  list.AddRectFilled(at, {at.x + size.x + 2 * pad, at.y + size.y + 2 * pad}, IM_COL32(20, 20, 20, 200),
                     3 * ui.scale());
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + pad, at.y + pad}, IM_COL32(230, 230, 230, 255),
               text.c_str(), nullptr, room);
}

void legend(Ui& ui, ImDrawList& list, const CompareState& compare, const PixelRect& clip) {
  const float u = ui.scale(), width = std::min(260 * u, static_cast<float>(clip.width) - 24 * u),
              height = 12 * u;
  const float line = ImGui::GetTextLineHeight();
  if (width < 80 * u || static_cast<float>(clip.height) < 3 * line + height + 24 * u) return;
  const ImVec2 at(static_cast<float>(clip.x) + 12 * u,
                  static_cast<float>(clip.y + clip.height) - height - 2 * line - 20 * u);
  list.AddRectFilled({at.x - 6 * u, at.y - 6 * u}, {at.x + width + 6 * u, at.y + height + 2 * line + 10 * u},
                     IM_COL32(20, 20, 20, 210), 3 * u);
  constexpr int kSteps = 128;
  for (int i = 0; i < kSteps; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / kSteps;
    const Rgb8 c = compare.with_sign ? map_signed_color(2 * t - 1) : map_color(ColorMap::magma, t);
    list.AddRectFilled({at.x + width * static_cast<float>(i) / kSteps, at.y},
                       {at.x + width * static_cast<float>(i + 1) / kSteps, at.y + height},
                       IM_COL32(c[0], c[1], c[2], 255));
  }
  const auto range = static_cast<double>(100 * compare.range);
  const std::string left = compare.with_sign ? fmt::format("-{} %", plot_number(range)) : "0.1 %";
  const std::string middle = compare.with_sign ? "0" : "";
  const std::string right = compare.with_sign ? fmt::format("+{} %", plot_number(range)) : "100 %";
  const ImU32 color = IM_COL32(225, 225, 225, 255);
  const float y = at.y + height + 2 * u;
  list.AddText({at.x, y}, color, left.c_str());
  list.AddText({at.x + 0.5f * (width - ImGui::CalcTextSize(middle.c_str()).x), y}, color, middle.c_str());
  list.AddText({at.x + width - ImGui::CalcTextSize(right.c_str()).x, y}, color, right.c_str());
  constexpr const char* kNames[] = {"A relative to B", "A relative to the reference",
                                    "B relative to the reference"};
  list.AddText({at.x, y + line}, color, kNames[static_cast<int>(compare.difference)]);
}

} // namespace

void compare_overlay(Ui& ui, const CompareState& compare, const ComparePanes& panes,
                     bool difference_is_there) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float pad = 8 * ui.scale();
  auto clipped = [&](const PixelRect& r, auto draw) {
    list.PushClipRect(corner(r), {static_cast<float>(r.x + r.width), static_cast<float>(r.y + r.height)});
    draw();
    list.PopClipRect();
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const ComparePanes::Pane& pane = panes.variants[i];
    if (!pane.shown || panes.difference) continue;
    const CompareVariant& variant = compare.variants[i];
    const std::string text =
        fmt::format("{}{}{}\n{}", variant_letter(static_cast<int>(i)), variant.label.empty() ? "" : ": ",
                    variant.label, variant_text(variant));
    clipped(pane.clip, [&] {
      plate(ui, list, {static_cast<float>(pane.clip.x) + pad, static_cast<float>(pane.clip.y) + pad},
            static_cast<float>(pane.clip.x + pane.clip.width) - pad, text);
    });
  }
  const PixelRect& all = panes.variants[0].clip;
  if (panes.difference) {
    clipped(all, [&] {
      if (difference_is_there)
        legend(ui, list, compare, all);
      else
        plate(ui, list, {static_cast<float>(all.x) + pad, static_cast<float>(all.y) + pad},
              static_cast<float>(all.x + all.width),
              compare.difference == DifferenceOf::a_and_b ? "Waiting for both pictures"
                                                          : "There is no reference: see Compare");
    });
  }
  if (panes.divider >= 0) {
    const auto x = static_cast<float>(panes.divider);
    const float top = static_cast<float>(all.y), bottom = static_cast<float>(all.y + all.height);
    const float u = ui.scale(), middle = 0.5f * (top + bottom);
    list.AddLine({x, top}, {x, bottom}, IM_COL32(0, 0, 0, 140), 3 * u);
    list.AddLine({x, top}, {x, bottom}, IM_COL32(240, 240, 240, 220), u);
    list.AddCircleFilled({x, middle}, 7 * u, IM_COL32(240, 240, 240, 230));
    list.AddTriangleFilled({x - 5 * u, middle}, {x - 2 * u, middle - 3 * u}, {x - 2 * u, middle + 3 * u},
                           IM_COL32(40, 40, 40, 255));
    list.AddTriangleFilled({x + 5 * u, middle}, {x + 2 * u, middle + 3 * u}, {x + 2 * u, middle - 3 * u},
                           IM_COL32(40, 40, 40, 255));
  }
}

} // namespace candela
