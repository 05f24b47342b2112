// The panel of lights and their groups.

#include "app/panels/panel_list.h"
#include "app/panels/texture_picker.h"
#include "app/ui/item_list.h"
#include "scene/light_layers.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace candela {

namespace {

/// The light as it was loaded, if the list still is the scene's.
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

/// The file of a light that may have one.
void file_of(Ui& ui, ViewerState& state, LightDesc& light) {
  const auto panorama = light_panorama(light);
  const auto profile = light_profile(light);
  const bool is_environment = std::holds_alternative<EnvironmentLightModel>(light.model);
  std::string shown = is_environment ? "none: constant radiance" : "none";
  if (panorama) shown = panorama->name;
  if (profile) shown = profile->name;
  const char* help = is_environment ? "The image of the environment"
                     : takes_profile(light)
                         ? "A photometric file (.ies), or a picture of the intensity by direction"
                         : "The picture that is thrown";
  ui.readout(is_environment ? "panorama" : "file", shown, help);
  const float button = 64 * ui.scale(), gap = ImGui::GetStyle().ItemSpacing.x;
  const std::string before = state.panorama_input;
  const bool entered =
      ui.text("light.file", is_environment ? "Path of a panorama, or drop it here" : "Path, or drop it here",
              state.panorama_input, -button - gap);
  if (state.panorama_input != before) state.settle(ErrorCause::open);
  ImGui::SameLine();
  const bool pressed =
      ui.button("light.open", "Open",
                is_environment ? "Lights the scene with this panorama (.exr, .hdr …)" : help, button);
  if ((entered || pressed) && !state.panorama_input.empty()) state.open_paths = {state.panorama_input};
  if (is_environment || (!panorama && !profile)) return;
  if (!ui.button("light.remove", "Remove", "The light shines without the file", 1.2f * button)) return;
  if (profile) set_profile(light, nullptr);
  if (panorama) set_panorama(light, nullptr);
  state.edited = true;
}

void group_of(Ui& ui, ViewerState& state, std::string& group) {
  const std::string before = group;
  ui.text("light.group", "Group: a name, to switch lights together", group, -1);
  state.edited |= group != before;
}

LightGroup group_of_name(const SceneDesc& scene, const std::string& name) {
  const auto known = std::ranges::find(scene.light_groups, name, &LightGroup::name);
  return known != scene.light_groups.end() ? *known : LightGroup{name};
}

/// The mixer of all groups.
void light_groups(Ui& ui, ViewerState& state) {
  SceneDesc& scene = state.document.scene;
  const std::vector<std::string> names = light_group_names(scene);
  if (names.empty()) return;
  if (const std::string problem = layers_problem(state.document); !problem.empty())
    ImGui::TextWrapped("Groups restart the picture: %s.", problem.c_str());
  for (std::size_t i = 0; i < names.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ui.readout("group", names[i], "Lights of one name are switched and scaled together");
    LightGroup group = group_of_name(scene, names[i]), home = group_of_name(state.home.scene, names[i]);
    bool changed = false;
    for (const auto& row : light_group_fields()) {
      FieldContext context;
      context.initial = row.address(home);
      changed |= ui.field(fmt::format("light_group.{}.{}", i, row.key), row, row.address(group), context);
    }
    if (changed) {
      light_group(scene, names[i]) = group;
      state.edited = true;
    }
    ImGui::PopID();
  }
}

void emission_fields_of(Ui& ui, ViewerState& state, std::size_t index) {
  Material& material = state.document.scene.materials[index];
  auto& home = state.home.scene.materials;
  const bool known = index < home.size() && home[index].model.index() == material.model.index();
  for (const MaterialField& row : common_material_fields()) {
    if (row.key != "emission" && row.key != "two_sided_emission") continue;
    FieldContext context;
    context.initial = known ? row.address(home[index]) : nullptr;
    state.edited |= ui.field(fmt::format("emitter.{}", row.key), row, row.address(material), context);
  }
}

} // namespace

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
    LightDesc& light = state.document.scene.lights[selected];
    if (takes_panorama(light) || takes_profile(light)) file_of(ui, state, light);
    group_of(ui, state, light.group);
  } else {
    const std::size_t material = shining[selected - lights.size()];
    emission_fields_of(ui, state, material);
    group_of(ui, state, state.document.scene.materials[material].group);
  }
  ImGui::PopID();
  light_groups(ui, state);
}

} // namespace candela
