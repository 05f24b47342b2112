// The panels of materials, lights and scenes.

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

/// The material as it was loaded, if the list still is the scene's.
template <class T>
void* initial_of(const Field<T>& row, std::vector<T>& home, std::size_t index) {
  return index < home.size() ? row.address(home[index]) : nullptr;
}

void light_fields_of(Ui& ui, ViewerState& state, std::size_t index) {
  LightDesc& light = state.document.scene.lights[index];
  auto& home = state.home.scene.lights;
  const bool same_type = index < home.size() && light_type(home[index]) == light_type(light);
  int type = light_type(light), home_type = index < home.size() ? light_type(home[index]) : type;
  FieldContext of_type;
  of_type.initial = &home_type;
  if (ui.field("light.type", light_type_field(), &type, of_type)) {
    change_type(light, type);
    state.edited = true;
    return; // the rows have changed
  }
  for (const auto& row : light_fields(light)) {
    FieldContext context;
    context.initial = same_type ? initial_of(row, home, index) : nullptr;
    context.drag_speed = 0.005f * state.natural_speed;
    state.edited |= ui.field(fmt::format("light.{}", row.key), row, row.address(light), context);
  }
}

void panorama_of(Ui& ui, ViewerState& state, const EnvironmentLightModel& light) {
  ui.readout("panorama", light.panorama ? light.panorama->name : "none: constant radiance",
             "The image of the environment");
  const float button = 64 * ui.scale();
  const std::string before = state.panorama_input;
  const bool entered = ui.text("light.file", "Path of a panorama, or drop it here", state.panorama_input,
                               -button - ImGui::GetStyle().ItemSpacing.x);
  if (state.panorama_input != before) state.settle(ErrorCause::open);
  ImGui::SameLine();
  const bool pressed =
      ui.button("light.open", "Open", "Lights the scene with this panorama (.exr, .hdr …)", button);
  if ((entered || pressed) && !state.panorama_input.empty()) state.open_paths = {state.panorama_input};
}

/// The loaded value, if the material still is the scene's and of the same type.
void* initial_of(const MaterialField& row, std::vector<Material>& home, const Material& material,
                 std::size_t index) {
  const bool known = index < home.size() && home[index].model.index() == material.model.index();
  return known ? row.address(home[index]) : nullptr;
}

void emission_fields_of(Ui& ui, ViewerState& state, std::size_t index) {
  Material& material = state.document.scene.materials[index];
  for (const MaterialField& row : common_material_fields()) {
    if (row.key != "emission" && row.key != "two_sided_emission") continue;
    FieldContext context;
    context.initial = initial_of(row, state.home.scene.materials, material, index);
    state.edited |= ui.field(fmt::format("emitter.{}", row.key), row, row.address(material), context);
  }
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

} // namespace

void materials_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.materials", "Materials", false)) return;
  auto& materials = state.document.scene.materials;
  if (materials.empty()) {
    ImGui::TextDisabled("The scene has none.");
    return;
  }
  state.selected_material = std::clamp(state.selected_material, 0, static_cast<int>(materials.size()) - 1);
  item_list(ui, "list.materials", materials.size(), state.reveal_selection ? state.selected_material : -1,
            [&](std::size_t i) {
              if (ui.item(fmt::format("materials/{}", i),
                          name_or_number(materials[i].name, "Material", i).c_str(),
                          static_cast<int>(i) == state.selected_material))
                state.selected_material = static_cast<int>(i);
            });
  const auto index = static_cast<std::size_t>(state.selected_material);
  Material& material = materials[index];
  ImGui::PushID(state.selected_material); // so that an unfinished entry belongs to one material
  material_type_of(ui, state, index);
  for (const MaterialField& row : material_fields(material)) {
    FieldContext context;
    context.initial = initial_of(row, state.home.scene.materials, material, index);
    material_field(ui, state, index, row, context);
  }
  ImGui::PopID();
}

void lights_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.lights", "Lights", false)) return;
  const auto& lights = state.document.scene.lights;
  const std::vector<std::size_t> shining = shining_materials(state.document.scene, state.home.scene);
  const std::size_t count = lights.size() + shining.size();
  if (count == 0) {
    ImGui::TextDisabled("The scene has none.");
    return;
  }
  state.selected_light = std::clamp(state.selected_light, 0, static_cast<int>(count) - 1);
  item_list(ui, "list.lights", count, state.reveal_selection ? state.selected_light : -1, [&](std::size_t i) {
    const bool is_light = i < lights.size();
    const std::size_t index = is_light ? i : shining[i - lights.size()];
    const std::string name = is_light ? fmt::format("lights/{}", index) : fmt::format("emitters/{}", index);
    const std::string label =
        is_light ? name_or_number(lights[index].name, "Light", index)
                 : fmt::format("{} (surface)",
                               name_or_number(state.document.scene.materials[index].name, "Material", index));
    if (!ui.item(name, label.c_str(), static_cast<int>(i) == state.selected_light)) return;
    state.selected_light = static_cast<int>(i);
    if (is_light) state.select_requested = Selection{Selection::Kind::light, static_cast<int>(index)};
  });
  const auto selected = static_cast<std::size_t>(state.selected_light);
  ImGui::PushID(state.selected_light);
  if (selected < lights.size()) {
    light_fields_of(ui, state, selected);
    if (const auto* environment = std::get_if<EnvironmentLightModel>(&lights[selected].model))
      panorama_of(ui, state, *environment);
  } else {
    emission_fields_of(ui, state, shining[selected - lights.size()]);
  }
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
