// The panels of materials and scenes.

#include "app/panels/material_picker.h"
#include "app/panels/medium_picker.h"
#include "app/panels/panel_list.h"
#include "app/panels/texture_picker.h"
#include "app/ui/item_list.h"
#include "materials/material_parts.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace candela {

namespace {

/// The loaded value, if the material still is the scene's and of the same type.
void* initial_of(const MaterialField& row, std::vector<Material>& home, const Material& material,
                 std::size_t index) {
  const bool known = index < home.size() && home[index].model.index() == material.model.index();
  return known ? row.address(home[index]) : nullptr;
}

void material_type_of(Ui& ui, ViewerState& state, std::size_t index) {
  Material& material = state.document.scene.materials[index];
  const auto& home = state.home.scene.materials;
  int type = material_type(material), initial = index < home.size() ? material_type(home[index]) : type;
  FieldContext context;
  context.initial = &initial;
  if (!ui.field("material.type", material_type_field(), &type, context)) return;
  const Material before = material;
  change_type(material, type);
  if (const auto problem = parts_problem(state.document.scene.materials)) { // others name it
    state.fail(ErrorCause::material, fmt::format("{}: {}", problem->cause, problem->remedy));
    material = before;
    return;
  }
  state.settle(ErrorCause::material);
  state.edited = true;
}

/// The selected material's, in its full size, with its name.
void selected_thumbnail(Ui& ui, ViewerState& state, std::size_t index) {
  const float side = std::round(64 * ui.scale());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy(ImVec2(side, side));
  ui.record("material.thumbnail");
  if (ImGui::IsItemVisible())
    draw_material_thumbnail(state, index, vec2(at.x, at.y), vec2(at.x + side, at.y + side));
  ImGui::SameLine();
  ImGui::TextUnformatted(
      name_or_number(state.document.scene.materials[index].name, "Material", index).c_str());
}

} // namespace

void materials_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.materials", "Materials", false)) return;
  auto& materials = state.document.scene.materials;
  if (materials.empty()) {
    ImGui::TextDisabled("The scene has none.");
    return;
  }
  state.selected_material = std::clamp(state.selected_material, 0, static_cast<int>(materials.size()) - 1);
  auto picture = [&](std::size_t i, vec2 lo, vec2 hi) { draw_material_thumbnail(state, i, lo, hi); };
  item_list(
      ui, "list.materials", materials.size(), state.reveal_selection ? state.selected_material : -1,
      [&](std::size_t i) {
        if (ui.item(fmt::format("materials/{}", i), name_or_number(materials[i].name, "Material", i).c_str(),
                    static_cast<int>(i) == state.selected_material, i, picture))
          state.selected_material = static_cast<int>(i);
      },
      ui.picture_side());
  const auto index = static_cast<std::size_t>(state.selected_material);
  Material& material = materials[index];
  selected_thumbnail(ui, state, index);
  ImGui::PushID(state.selected_material); // so that an unfinished entry belongs to one material
  material_type_of(ui, state, index);
  for (const MaterialField& row : material_fields(material)) {
    FieldContext context;
    context.initial = initial_of(row, state.home.scene.materials, material, index);
    material_field(ui, state, index, row, context);
  }
  if (!state.document.scene.media.empty())
    state.edited |= medium_field(ui, state, "material.medium", "medium", material.medium,
                                 "What fills bodies of this material, where light enters them");
  ImGui::PopID();
}

void scenes_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.scenes", "Scenes", false)) return;
  item_list(ui, "list.scenes", state.scenes.size(), -1, [&](std::size_t i) {
    const std::string path = state.scenes[i].string();
    if (ui.item(fmt::format("scenes/{}", i), state.scenes[i].stem().string().c_str(),
                path == state.scene_path))
      state.open_paths = {path};
    ui.tooltip(path);
  });
  const float button = 64 * ui.scale();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const std::string before = state.path_input;
  const bool entered =
      ui.text("scene.path", "Path of a scene, or drop it here", state.path_input, -button - gap);
  if (state.path_input != before) state.settle(ErrorCause::open);
  ImGui::SameLine();
  const bool pressed =
      ui.button("scene.open", "Open", "Reads the scene while the current one keeps running", button);
  if ((entered || pressed) && !state.path_input.empty()) state.open_paths = {state.path_input};
  if (ui.button("scene.save", "Save", "Writes the scene as JSON (Ctrl+S)", button))
    state.save_scene_requested = true;
  ImGui::SameLine();
  if (ui.button("scene.save_as", "Save as", "Writes it under another name (Ctrl+Shift+S)", 1.2f * button))
    state.save_scene_requested = state.save_as_requested = true;
  // The author's description, shortened: a file may hold a very long text.
  constexpr std::size_t kMostText = 2000;
  const std::string text = state.document.scene.description.substr(0, kMostText);
  if (!text.empty()) {
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ui.record("scene.description");
  }
  if (!state.recent.empty()) {
    ImGui::TextDisabled("Recent");
    item_list(ui, "list.recent", state.recent.size(), -1, [&](std::size_t i) {
      const std::string& path = state.recent[i];
      if (ui.item(fmt::format("recent/{}", i), std::filesystem::path(path).filename().string().c_str(),
                  path == state.scene_path))
        state.open_paths = {path};
      ui.tooltip(path);
    });
  }
  for (const std::string& warning : state.warnings) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s", warning.c_str());
    ImGui::PopTextWrapPos();
  }
}

} // namespace candela
