// The tools above the panels: what is needed at any time.

#include "app/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

/// A row of equally wide buttons that fills the width.
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

} // namespace

void tool_bar(Ui& ui, ViewerState& state, vec2 position, vec2 size) {
  ImGui::SetNextWindowPos(ImVec2(position.x, position.y));
  ImGui::SetNextWindowSize(ImVec2(size.x, size.y));
  if (ImGui::Begin("##tools", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                       ImGuiWindowFlags_NoBringToFrontOnFocus)) {
    ButtonRow row(ui, ImGui::GetContentRegionAvail().x, 4);
    if (row.button("undo", "Undo", step_tip("undo", state.undo_name, "Ctrl+Z"), !state.undo_name.empty()))
      state.undo_requested = true;
    if (row.button("redo", "Redo", step_tip("redo", state.redo_name, "Ctrl+Shift+Z, Ctrl+Y"),
                   !state.redo_name.empty()))
      state.redo_requested = true;
    if (row.button("pause", state.paused ? "Resume" : "Pause",
                   "Stops and goes on accumulating (K, Pause); an edit still shows its first pass", true,
                   state.paused))
      state.paused = !state.paused;
    if (row.button("step", "Step", "One more sample for every pixel, then a pause (L)"))
      state.step_requested = true;
  }
  ImGui::End();
}

} // namespace candela
