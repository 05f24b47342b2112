// The strips over the picture: errors, questions, loading progress. None is modal.

#include "app/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h> // which window lies over which

#include <algorithm>
#include <utility>

namespace candela {

namespace {

constexpr double kQuietSeconds = 0.3; // shorter work is not shown

const ImVec4 kRed(0.36f, 0.12f, 0.10f, 0.97f), kGrey(0.20f, 0.20f, 0.20f, 0.97f);

/// Strips stacked from the top of the picture.
class Strips {
public:
  Strips(Ui& ui, vec2 position, float width) : ui_(ui), position_(position), width_(width) {}

  template <class Content>
  void strip(const char* id, const ImVec4& color, Content content) {
    ImGui::SetNextWindowPos(ImVec2(position_.x, position_.y));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width_, 0), ImVec2(width_, 1e6f));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color);
    if (ImGui::Begin(id, nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize))
      content();
    // Kept in front of all overlays of the picture.
    if (ImGui::GetCurrentContext()->OpenPopupStack.empty())
      ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    position_.y += ImGui::GetWindowHeight();
    ImGui::End();
    ImGui::PopStyleColor();
  }

  /// A text with room for `buttons` of button_width() at its right, where the cursor is then.
  void text(const std::string& text, int buttons) {
    const float room = static_cast<float>(buttons) * (button_width() + ImGui::GetStyle().ItemSpacing.x);
    const float left = std::max(width_ - room - ImGui::GetStyle().WindowPadding.x, 1.0f);
    ImGui::AlignTextToFramePadding();
    ImGui::PushTextWrapPos(std::max(left - ImGui::GetStyle().WindowPadding.x, 1.0f));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    text_end_ = left;
  }
  bool button(const char* name, const char* label, std::string_view tip = {}) {
    ImGui::SameLine(text_end_);
    text_end_ += button_width() + ImGui::GetStyle().ItemSpacing.x;
    return ui_.button(name, label, tip, button_width());
  }
  float button_width() const { return 84 * ui_.scale(); }
  float bottom() const { return position_.y; }

private:
  Ui& ui_;
  vec2 position_;
  float width_, text_end_ = 0;
};

void question(Ui& ui, ViewerState& state, Strips& strips) {
  const std::string name = scene_title(state);
  switch (state.question) {
  case Question::none: return;
  case Question::quit:
    strips.text(fmt::format("{} has edits that are not saved.", name), 3);
    ui.record("question.quit");
    if (strips.button("quit.save", "Save, quit")) state.save_and_quit_requested = true;
    if (strips.button("quit.anyway", "Discard", "Quits without saving (Ctrl+Q again)"))
      state.close_requested = true;
    if (strips.button("quit.stay", "Stay")) state.question = Question::none;
    return;
  case Question::reload:
    strips.text(fmt::format("{} has changed on the disk; here it has edits that are not saved.", name), 2);
    ui.record("question.reload");
    if (strips.button("reload.yes", "Reload", "Undo brings your edits back")) {
      state.reload_requested = true;
      state.question = Question::none;
    }
    if (strips.button("reload.no", "Keep mine")) state.question = Question::none;
    return;
  case Question::replace:
    strips.text(fmt::format("{} exists.", state.replace_path), 2);
    ui.record("question.replace");
    if (strips.button("replace.yes", "Replace")) state.save_to = state.replace_path;
    if (strips.button("replace.no", "Keep it")) {
      state.question = Question::none;
      state.replace_path.clear();
    }
    return;
  }
}

void save_as(Ui& ui, ViewerState& state, Strips& strips, float width) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Save as");
  ImGui::SameLine();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float field =
      width - ImGui::GetCursorPosX() - 2 * (strips.button_width() + gap) - ImGui::GetStyle().WindowPadding.x;
  const std::string before = state.save_path;
  const bool entered = ui.asked_path("save.path", "Path of a .json file", state.save_path,
                                     std::max(field, 40.0f), state.save_field_wanted);
  const bool escaped = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  if (state.save_path != before) { // messages and questions were about another name
    state.settle(ErrorCause::save);
    if (state.question == Question::replace) state.question = Question::none;
    state.replace_path.clear();
  }
  ImGui::SameLine();
  const bool pressed =
      ui.button("save.to", "Save", "Meshes in its folder are referred to, others are written into it",
                strips.button_width());
  ImGui::SameLine();
  if (ui.button("save.cancel", "Cancel", {}, strips.button_width()) || escaped) state.give_up_saving();
  if ((entered || pressed) && !state.save_path.empty()) state.save_to = state.save_path;
}

void working_bar(double share, float unit) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 3 * unit;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, ImVec2(at.x + width, at.y + height), ImGui::GetColorU32(ImGuiCol_FrameBg));
  list.AddRectFilled(at, ImVec2(at.x + width * static_cast<float>(share), at.y + height),
                     ImGui::GetColorU32(ImGuiCol_CheckMark));
  ImGui::Dummy(ImVec2(width, height));
}

} // namespace

void message_strips(Ui& ui, ViewerState& state, vec2 position, vec2 room) {
  const float width = room.x, height = std::exchange(state.strips_bottom, 0.0f);
  if (width < 1) return;
  // Questions come first, so that later messages do not move them under the pointer.
  Strips asking(ui, position, width);
  if (state.save_as_visible) asking.strip("##save", kGrey, [&] { save_as(ui, state, asking, width); });
  if (state.question != Question::none)
    asking.strip("##question", kGrey, [&] { question(ui, state, asking); });

  // The other strips must not cover the field that is being edited, which may be in the lab.
  const auto typed = ui.typed_field();
  const bool in_the_way = typed && typed->name != "save.path" && typed->lo.x < position.x + width &&
                          typed->lo.y < position.y + std::max(height, 64 * ui.scale());
  const float top = in_the_way ? position.y + room.y - std::max(state.told_height, 1.0f) : asking.bottom();
  Strips strips(ui, vec2(position.x, top), width);
  const bool reading = state.reading && state.now - state.loading_since > kQuietSeconds;
  const bool building = !state.reading && state.status.phase == SessionPhase::building &&
                        state.now - state.building_since > kQuietSeconds;
  if (reading || building)
    strips.strip("##working", kGrey, [&] {
      const double share = reading ? state.loaded : state.status.built;
      strips.text(fmt::format("{} {} … {:.0f} %", reading ? "Reading" : "Building the geometry of",
                              reading ? state.loading_path : scene_title(state), std::floor(100 * share)),
                  1);
      ui.record("working");
      if (reading && strips.button("working.cancel", "Cancel", "Keeps the current scene (Esc)"))
        state.cancel_requested = true;
      if (building && state.may_stop_building &&
          strips.button("working.cancel", "Cancel", "Back to the previous state (Esc)"))
        state.cancel_requested = true;
      working_bar(share, ui.scale());
    });
  if (!state.error.empty())
    strips.strip("##error", kRed, [&] {
      strips.text(state.error, 1);
      ui.record("error.text");
      if (strips.button("error.dismiss", "Dismiss", "Esc")) state.error.clear();
    });
  state.told_height = strips.bottom() - top;
  state.strips_bottom = in_the_way ? asking.bottom() : strips.bottom();
}

} // namespace candela
