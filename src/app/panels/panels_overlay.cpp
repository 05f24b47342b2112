// Overlays of the picture: help, and the initial hint. None is modal.

#include "app/panels/panels.h"

#include <imgui.h>

#include <algorithm>
#include <span>

namespace candela {

namespace {

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_NoFocusOnAppearing;

struct KeyHelp {
  const char* keys;
  const char* what;
};
constexpr KeyHelp kViewKeys[] = {
    {"W S, Up Down", "fly forward, back"},
    {"Q E, Left Right", "fly to the left, right"},
    {"Space X", "fly up, down"},
    {"A D", "look to the left, right"},
    {"Insert Delete", "look up, down"},
    {"drag", "look around"},
    {"Shift", "four times as fast"},
    {"middle drag, Alt+drag", "orbit; Shift pans, Ctrl zooms"},
    {"wheel", "zoom; while a key flies: its speed"},
    {"number pad 1 3 7", "front, right, top; Ctrl: other side"},
    {"number pad 5", "perspective or orthographic"},
    {"number pad .", "frame the selection, or the scene"},
    {"Home", "the view that the scene came with"},
    {"1 to 9, Ctrl+1 to 9", "go to a bookmark, store one"},
    {"F, Ctrl+click", "focus there"},
    {"O", "show what is in focus"},
    {"I, H", "probe the pixel at the mouse, hold it"},
};
constexpr KeyHelp kWorkKeys[] = {
    {"click, Esc", "select what is there, nothing"},
    {"V, G, R, T", "select, move, rotate, scale"},
    {"Ctrl while dragging", "moves, rotates, scales in steps"},
    {"M", "show or hide icons and outlines"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo (or Ctrl+Shift+Z)"},
    {"Ctrl+B, Ctrl+Alt+B", "render a region, all again"},
    {"K or Pause, L", "pause or go on, one sample more"},
    {"C, N, B", "compare; change the layout; flip"},
    {"F2", "the lab: Monte Carlo lessons"},
    {"Ctrl+S, Ctrl+Shift+S", "save the scene, under another name"},
    {"P", "save PNG and EXR under new names"},
    {"drop a file", "open that scene or picture"},
    {"Tab", "hide or show all panels"},
    {"Ctrl + - 0", "larger, smaller, normal text"},
    {"Ctrl+click, double click", "type a value, reset it"},
    {"F1, Esc", "show or hide this help"},
    {"Ctrl+Q", "quit"},
};

void key_list(std::span<const KeyHelp> keys, float column) {
  ImGui::BeginGroup();
  for (const KeyHelp& line : keys) {
    ImGui::TextUnformatted(line.keys);
    ImGui::SameLine(column);
    ImGui::TextDisabled("%s", line.what);
  }
  ImGui::EndGroup();
}

} // namespace

void help_overlay(Ui& ui, ViewerState& state, vec2 center, vec2 room) {
  if (!state.help_visible) return;
  ImGui::SetNextWindowPos(ImVec2(center.x, center.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(1, 1), ImVec2(std::max(room.x, 1.0f), std::max(room.y, 1.0f)));
  ImGui::SetNextWindowBgAlpha(0.95f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(22 * ui.scale(), 16 * ui.scale()));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * ui.scale());
  if (ImGui::Begin("##help", nullptr,
                   (kOverlay & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysAutoResize)) {
    // Two columns, so that all keys fit into a window of 1280x720.
    const float column = 165 * ui.scale();
    key_list(kViewKeys, column);
    if (room.x > 860 * ui.scale()) ImGui::SameLine(0, 20 * ui.scale());
    key_list(kWorkKeys, column);
    ImGui::Dummy(ImVec2(0, 4 * ui.scale()));
    if (ui.button("help.close", "Close")) state.help_visible = false;
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void picture_label(Ui& ui, const ViewerState& state, vec2 top_left) {
  const bool denoised = state.picture && state.picture->denoised;
  if (!denoised && state.picture_of.empty()) return;
  ImGui::SetNextWindowPos(ImVec2(top_left.x + 12 * ui.scale(), top_left.y + 12 * ui.scale()));
  ImGui::SetNextWindowBgAlpha(0.6f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * ui.scale());
  if (ImGui::Begin("##label", nullptr,
                   kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
    if (!state.picture_of.empty()) {
      ImGui::TextUnformatted(state.picture_of.c_str());
      ui.record("picture.old");
    }
    if (denoised) {
      ImGui::TextUnformatted(denoised_text(*state.picture->denoised).c_str());
      ui.record("picture.denoised");
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void floating_line(Ui& ui, const char* name, std::string_view text, vec2 bottom_center) {
  ImGui::SetNextWindowPos(ImVec2(bottom_center.x, bottom_center.y - 12 * ui.scale()), ImGuiCond_Always,
                          ImVec2(0.5f, 1));
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * ui.scale());
  if (ImGui::Begin("##floating", nullptr,
                   kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ui.record(name);
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

} // namespace candela
