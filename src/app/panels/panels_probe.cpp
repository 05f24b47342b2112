#include "app/panels/panels_probe.h"

#include "app/ui/typed_number.h"
#include "core/color.h"
#include "imaging/exposure.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

constexpr ImGuiWindowFlags kProbeWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                          ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs;

/// Four digits, of constant length except for the sign and huge or tiny values.
std::string digits(float value) {
  const float size = std::abs(value);
  if (size != 0 && (size < 1e-3f || size >= 1e7f)) return fmt::format("{:.3e}", value);
  return fmt::format("{:.{}f}", value,
                     size < 10     ? 4
                     : size < 100  ? 3
                     : size < 1000 ? 2
                     : size < 1e5f ? 1
                                   : 0);
}

std::string triple(vec3 v) { return fmt::format("{}  {}  {}", digits(v.x), digits(v.y), digits(v.z)); }

/// A name from the scene, or its index if it has none.
template <class T>
std::string name_of(const std::vector<T>& things, int index, const char* kind) {
  if (index < 0 || static_cast<std::size_t>(index) >= things.size()) return "-";
  const std::string& name = things[static_cast<std::size_t>(index)].name;
  return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

struct TextRow {
  const char* label;
  std::string value;
};

std::vector<TextRow> picture_rows(const DisplayImage& picture, ivec2 pixel) {
  const Frame& frame = *picture.frame;
  const auto index = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(frame.width) +
                     static_cast<std::size_t>(pixel.x);
  const vec3 value = picture.linear()[index];
  const std::uint8_t* shown = picture.rgba.data() + 4 * index;
  std::vector<TextRow> rows = {{"pixel", fmt::format("{}, {}", pixel.x, pixel.y)}};
  if (is_scalar_view(frame.view)) {
    rows.push_back({"value", fmt::format("{} {}", digits(value.x), view_unit(frame.view))});
  } else {
    rows.push_back({picture.denoised ? "denoised" : "linear RGB", triple(value)});
    const float l = luminance(value);
    rows.push_back({"luminance", digits(l)});
    if (frame.view == View::radiance) {
      const float stops = std::log2(l / kMiddleGrey) + picture.transform.tone.exposure;
      rows.push_back({"exposed", l > 0 ? fmt::format("{:+.2f} stops from middle grey", stops) : "black"});
    }
  }
  rows.push_back({"shown sRGB", fmt::format("{} {} {}  #{:02x}{:02x}{:02x}", shown[0], shown[1], shown[2],
                                            shown[0], shown[1], shown[2])});
  if (frame.samples.empty()) { // the first pass is coarse
    rows.push_back({"samples", "-"});
    rows.push_back({"std error", "-"});
    return rows;
  }
  rows.push_back({"samples", fmt::format("{}", frame.samples[index])});
  // Of the pixel's mean before denoising, by channel; the relative one is of all channels together.
  const vec3 variance = frame.variance[index];
  const float mean = average(frame.linear[index]);
  rows.push_back({"std error", triple(glm::sqrt(variance))});
  if (frame.view == View::radiance && mean > 0)
    rows.back().value += fmt::format("  {:.1f} %", 100 * std::sqrt(average(variance)) / mean);
  return rows;
}

std::vector<TextRow> scene_rows(const ViewerState& state, const std::optional<Pick>& pick) {
  if (!pick) return {{"object", "nothing"}};
  const SceneDesc& scene = state.document.scene;
  return {
      {"object", name_of(scene.instances, pick->instance, "Instance")},
      {"material", name_of(scene.materials, pick->material, "Material")},
      {"point", triple(pick->position)},
      {"normal", triple(pick->geometric_normal)},
      {"uv", fmt::format("{}  {}", digits(pick->uv.x), digits(pick->uv.y))},
      {"distance", fmt::format("{}, {} along the view", digits(pick->distance), digits(pick->view_depth))}};
}

void text_rows(const std::vector<TextRow>& rows, float column) {
  for (const TextRow& row : rows) {
    ImGui::TextDisabled("%s", row.label);
    ImGui::SameLine(column);
    ImGui::TextUnformatted(row.value.c_str());
  }
}

/// Round steps (1, 2 or 5 times a power of ten) for about `count` ticks over a length.
double tick_step(double length, int count) {
  const double rough = length / count;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

std::vector<double> legend_ticks(const FalseColorScale& scale) {
  std::vector<double> ticks;
  const auto lo = static_cast<double>(scale.lo), hi = static_cast<double>(scale.hi);
  if (scale.logarithmic) {
    const double first = std::ceil(std::log10(lo)), last = std::floor(std::log10(hi));
    if (last - first >= 1) { // whole decades
      for (double e = first; e <= last; ++e) ticks.push_back(std::pow(10, e));
      return ticks;
    }
  }
  const double step = tick_step(hi - lo, 4);
  for (double t = std::ceil(lo / step); t * step <= hi * (1 + 1e-6); ++t) ticks.push_back(t * step);
  return ticks;
}

std::string view_name(View view) {
  Document document;
  document.settings.view = view;
  std::string name = field_text(*find_setting("view"), document);
  std::ranges::replace(name, '_', ' ');
  return name;
}

} // namespace

void probe_overlay(Ui& ui, ViewerState& state, const PixelRect& picture, vec2 top_left) {
  const InspectState& inspect = state.inspect;
  if (!inspect.probe_visible || !state.picture) return;
  const float unit = ui.scale();
  ImGui::SetNextWindowPos(ImVec2(top_left.x + 12 * unit, top_left.y + 12 * unit));
  ImGui::SetNextWindowSize(ImVec2(348 * unit, 0)); // constant, so that it does not change with the numbers
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * unit);
  if (ImGui::Begin("##probe", nullptr, kProbeWindow)) {
    if (!inspect.probe_pixel) {
      ImGui::TextDisabled("Point at the picture; H holds a pixel");
    } else {
      const float column = 96 * unit;
      text_rows(picture_rows(*state.picture, *inspect.probe_pixel), column);
      ImGui::Separator();
      text_rows(scene_rows(state, inspect.probe_pick), column);
      ImGui::TextDisabled("%s", inspect.probe_frozen ? "held; H releases" : "H holds this pixel");
    }
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ui.record("probe", vec2(at.x, at.y), vec2(at.x + size.x, at.y + size.y));
  }
  ImGui::End();
  ImGui::PopStyleVar();
  if (!inspect.probe_frozen || !inspect.probe_pixel) return;
  const vec2 film(state.picture->width, state.picture->height);
  const vec2 side = vec2(picture.width, picture.height) / film;
  const vec2 lo = vec2(picture.x, picture.y) + vec2(*inspect.probe_pixel) * side;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (auto [color, margin] :
       {std::pair(IM_COL32(0, 0, 0, 255), 3 * unit), std::pair(IM_COL32_WHITE, 2 * unit)})
    list.AddRect(ImVec2(lo.x - margin, lo.y - margin), ImVec2(lo.x + side.x + margin, lo.y + side.y + margin),
                 color, 0, 0, unit);
}

void draw_focus_mark(Ui& ui, ViewerState& state, const PixelRect& picture, double now) {
  std::optional<InspectState::FocusMark>& mark = state.inspect.focus_mark;
  if (mark && now > mark->until) mark.reset();
  if (!mark || !state.picture) return;
  const ivec2 film(state.picture->width, state.picture->height);
  const auto at = CameraView(state.document.scene.camera, film.x, film.y).project(mark->position);
  if (!at) return;
  const vec2 p = vec2(picture.x, picture.y) + *at * vec2(picture.width, picture.height) / vec2(film);
  const float unit = ui.scale(), arm = 9 * unit, gap = 3 * unit;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const std::string text = scene_units(mark->view_depth);
  for (auto [color, thickness] :
       {std::pair(IM_COL32(0, 0, 0, 200), 3 * unit), std::pair(IM_COL32_WHITE, unit)}) {
    for (vec2 d : {vec2(1, 0), vec2(-1, 0), vec2(0, 1), vec2(0, -1)})
      list.AddLine(ImVec2(p.x + gap * d.x, p.y + gap * d.y), ImVec2(p.x + arm * d.x, p.y + arm * d.y), color,
                   thickness);
  }
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const vec2 corner(p.x + arm + 2 * unit, p.y - 0.5f * size.y);
  list.AddRectFilled(ImVec2(corner.x, corner.y - 2 * unit),
                     ImVec2(corner.x + size.x + 10 * unit, corner.y + size.y + 2 * unit),
                     IM_COL32(20, 20, 20, 210), 3 * unit);
  list.AddText(ImVec2(corner.x + 5 * unit, corner.y), IM_COL32(235, 235, 235, 255), text.c_str());
  ui.record("focus.mark", p - arm, p + arm);
}

void legend_overlay(Ui& ui, const ViewerState& state, vec2 bottom_left) {
  if (!state.picture || !state.picture->transform.false_color) return;
  const FalseColorScale& scale = *state.picture->transform.false_color;
  const float unit = ui.scale(), width = 280 * unit, height = 12 * unit, side = 22 * unit;
  ImGui::SetNextWindowPos(ImVec2(bottom_left.x + 12 * unit, bottom_left.y - 12 * unit), ImGuiCond_Always,
                          ImVec2(0, 1));
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * unit);
  if (ImGui::Begin("##legend", nullptr, kProbeWindow | ImGuiWindowFlags_AlwaysAutoResize)) {
    const std::string_view unit_name = view_unit(state.picture->frame->view);
    ImGui::TextUnformatted(view_name(state.picture->frame->view).c_str());
    if (!unit_name.empty()) {
      ImGui::SameLine();
      ImGui::TextDisabled("%.*s%s", static_cast<int>(unit_name.size()), unit_name.data(),
                          scale.logarithmic ? ", logarithmic" : "");
    }
    ImGui::Dummy(ImVec2(width + 2 * side, height + 4 * unit + ImGui::GetTextLineHeight()));
    ui.record("legend");
    const ImVec2 item = ImGui::GetItemRectMin();
    const float x0 = item.x + side, y0 = item.y;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    auto color = [&](float t) {
      const auto c = map_color(scale.map, t);
      return IM_COL32(c[0], c[1], c[2], 255);
    };
    constexpr int kPieces = 64;
    for (int i = 0; i < kPieces; ++i) {
      const float t0 = static_cast<float>(i) / kPieces, t1 = static_cast<float>(i + 1) / kPieces;
      list.AddRectFilledMultiColor(ImVec2(x0 + t0 * width, y0), ImVec2(x0 + t1 * width, y0 + height),
                                   color(t0), color(t1), color(t1), color(t0));
    }
    float free_from = -kInfinity; // labels must not touch
    for (double tick : legend_ticks(scale)) {
      const float x = x0 + scale.position(static_cast<float>(tick)) * width;
      list.AddLine(ImVec2(x, y0 + height), ImVec2(x, y0 + height + 3 * unit),
                   ImGui::GetColorU32(ImGuiCol_Text));
      const std::string text = plain_number(tick, 4);
      const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
      if (x - half < free_from) continue;
      list.AddText(ImVec2(x - half, y0 + height + 4 * unit), ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
      free_from = x + half + 6 * unit;
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void focus_rows(Ui& ui, ViewerState& state) {
  const Camera& camera = state.document.scene.camera;
  const FilmSettings& film = state.document.settings.film;
  const CameraView view(camera, film.width, film.height);
  std::string sharp = "everywhere (pinhole)";
  if (view.has_lens()) {
    const CameraView::Interval interval = view.depth_of_field(sharp_blur(film.height));
    const std::string near = plain_number(static_cast<double>(interval.near), 4);
    sharp = interval.far == kInfinity
                ? fmt::format("from {}", near)
                : fmt::format("{} to {}", near, plain_number(static_cast<double>(interval.far), 4));
  }
  ui.readout("in focus at", scene_units(camera.effective_focus_distance()),
             "Distance of the plane of focus along the view axis");
  ui.readout("sharp", sharp,
             "Distances along the view axis at which the blur is below 1/500 of the picture's height");
  static constexpr FieldInfo kRow{
      "focus.show_plane",
      FieldType::boolean,
      0,
      0,
      "",
      "Tints what is in focus and draws a line where the plane of focus intersects surfaces (O)",
      Invalidates::nothing};
  const bool initial = false;
  ui.field("focus.show_plane", kRow, &state.inspect.focus_plane_visible, {&initial, "show focus (O)", 0});
}

} // namespace candela
