// The tools above the panels.

#include "app/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

/// A row of buttons of equal width that fills the column.
class ButtonRow {
public:
  ButtonRow(Ui& ui, float width, int count) : ui_(ui) {
    gap_ = ImGui::GetStyle().ItemInnerSpacing.x;
    width_ = std::floor((width - gap_ * static_cast<float>(count - 1)) / static_cast<float>(count));
  }
  bool button(const char* name, const char* label, const std::string& tip, bool enabled = true,
              bool pressed = false) {
    if (!first_) ImGui::SameLine(0, gap_);
    first_ = false;
    ImGui::BeginDisabled(!enabled);
    if (pressed) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrabActive));
    const bool clicked = ui_.button(name, label, tip, width_);
    if (pressed) ImGui::PopStyleColor();
    ImGui::EndDisabled();
    return clicked;
  }

private:
  Ui& ui_;
  float gap_ = 0, width_ = 0;
  bool first_ = true;
};

std::string step_tip(const char* verb, const std::string& name, const char* keys) {
  if (name.empty()) return fmt::format("There is nothing to {} ({})", verb, keys);
  return fmt::format("{}{}: {} ({})", static_cast<char>(std::toupper(verb[0])), verb + 1, name, keys);
}

/// The tools that edit the selection with the mouse.
void tool_buttons(Ui& ui, ViewerState& state) {
  constexpr struct {
    Tool tool;
    const char *name, *label, *tip;
  } kTools[] = {
      {Tool::select, "tool.select", "Select", "A click selects, a drag looks around (V)"},
      {Tool::move, "tool.move", "Move", "Handles that move the selection (G); Ctrl snaps"},
      {Tool::rotate, "tool.rotate", "Rotate",
       "Rings that rotate the selection (R); Ctrl snaps to 15 degrees"},
      {Tool::scale, "tool.scale", "Scale", "Handles that scale the selection (T; S flies); Ctrl snaps"},
  };
  ButtonRow row(ui, ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize, 5);
  for (const auto& entry : kTools)
    if (row.button(entry.name, entry.label, entry.tip, true, state.tool == entry.tool))
      state.tool = entry.tool;
  const bool limited = state.region.has_value();
  if (row.button("region", "Region",
                 limited ? "Renders the whole picture again (Ctrl+Alt+B)"
                         : "Drag a rectangle over the picture: only that accumulates (Ctrl+B)",
                 true, limited || state.region_armed)) {
    state.region_armed = !limited && !state.region_armed;
    state.region.reset();
  }
}

} // namespace

void tool_bar(Ui& ui, ViewerState& state, vec2 position, vec2 size) {
  ImGui::SetNextWindowPos(ImVec2(position.x, position.y));
  ImGui::SetNextWindowSize(ImVec2(size.x, size.y));
  if (ImGui::Begin("##tools", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                       ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoBackground)) {
    ButtonRow row(ui, ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize, 4);
    if (row.button("undo", "Undo", step_tip("undo", state.undo_name, "Ctrl+Z"), !state.undo_name.empty()))
      state.undo_requested = true;
    if (row.button("redo", "Redo", step_tip("redo", state.redo_name, "Ctrl+Shift+Z, Ctrl+Y"),
                   !state.redo_name.empty()))
      state.redo_requested = true;
    if (row.button("pause", state.paused ? "Resume" : "Pause",
                   "Pauses or continues accumulating (K, Pause); edits still show their first pass", true,
                   state.paused))
      state.paused = !state.paused;
    if (row.button("step", "Step", "One more sample for every pixel, then a pause (L)"))
      state.step_requested = true;
    tool_buttons(ui, state);
  }
  ImGui::End();
}

} // namespace candela
