// The panels generated from the settings table: Render, Display and the camera's rows.

#include "app/panels/panel_list.h"
#include "app/panels/panels_probe.h"
#include "app/tools/fly_camera.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

std::string_view group_of(std::string_view key) { return key.substr(0, key.find('.')); }

/// The values that a group is reset to: the table's defaults, or the scene's camera.
const Document& default_document() {
  static const Document document;
  return document;
}

bool setting(Ui& ui, const Field<Document>& row, Document& document, const Document& initial,
             float drag_speed) {
  FieldContext context;
  context.initial = row.address(const_cast<Document&>(initial));
  context.drag_speed = drag_speed;
  return ui.field(std::string(row.key), row, row.address(document), context);
}

struct Group {
  std::string_view prefix;
  const char* title;
  bool open_at_first;
};
constexpr Group kGroups[] = {
    {"path", "Light paths", true},       {"sampler", "Sampler", false},
    {"stop", "When to stop", false},     {"film", "Film", false},
    {"override", "One material", false}, {"adaptive", "Adaptive sampling", false},
    {"ao", "Ambient occlusion", false},  {"view", "View", true},
};

/// The groups above come first, in that order, then all other groups of the table.
std::vector<Group> render_groups(std::vector<std::string>& storage) {
  std::vector<Group> groups(std::begin(kGroups), std::end(kGroups));
  storage.reserve(settings_table().size());
  for (const auto& row : settings_table()) {
    const std::string_view prefix = group_of(row.key);
    if (prefix == "camera" || prefix == "display") continue;
    if (std::ranges::any_of(groups, [&](const Group& g) { return g.prefix == prefix; })) continue;
    storage.emplace_back(prefix);
    groups.push_back({prefix, storage.back().c_str(), false});
  }
  return groups;
}

/// Whether the setting has an effect: values of the material that overrides others, once there is one.
bool is_override_shown(std::string_view key, const Document& document) {
  const OverrideSettings& chosen = document.settings.override_brdf;
  const std::string_view value = key.substr(group_of(key).size() + 1);
  if (value == "brdf") return true;
  const MaterialField* row = chosen.is_on() ? find_material_field(chosen.brdf - 1, value) : nullptr;
  return row != nullptr && row->kept;
}

void film_size_choice(Ui& ui, ViewerState& state) {
  constexpr std::string_view kChoices[] = {"fit window", "fixed"};
  int chosen = state.fit_film ? 0 : 1;
  if (ui.choice("film.size", "size", chosen, kChoices,
                "Whether the film has the window's size or a fixed one.\nRestarts the image when the size "
                "changes."))
    state.fit_film = chosen == 0;
}

} // namespace

void render_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.render", "Render", true)) return;
  std::vector<std::string> storage;
  for (const Group& group : render_groups(storage)) {
    const bool single = find_setting(group.prefix) != nullptr; // a setting without a group of its own
    if (!single &&
        !ui.subsection(fmt::format("group.{}", group.prefix).c_str(), group.title, group.open_at_first))
      continue;
    if (group.prefix == "film") film_size_choice(ui, state);
    for (const auto& row : settings_table()) {
      if (group_of(row.key) != group.prefix) continue;
      if (group.prefix == "override" && !is_override_shown(row.key, state.document)) continue;
      const bool fitted = state.fit_film && (row.key == "film.width" || row.key == "film.height");
      // The size of a film that fits the window is not an edit, so it is its own default.
      const Document& initial = fitted ? state.document : default_document();
      if (!setting(ui, row, state.document, initial, 0.01f)) continue;
      state.edited = true;
      if (fitted) state.fit_film = false;
    }
  }
}

void display_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.display", "Display", true)) return;
  for (const auto& row : settings_table())
    if (group_of(row.key) == "display")
      state.edited |= setting(ui, row, state.document, default_document(), 0.01f);
  if (state.picture && state.document.settings.display.auto_exposure)
    ui.readout("found exposure", fmt::format("{:+.2f} stops", state.picture->transform.automatic_exposure),
               "Added to the exposure by auto exposure");
  if (ui.button("save", "Save PNG and EXR",
                "Writes the picture as PNG and as linear EXR under new names (P)"))
    state.save_requested = true;
}

void camera_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.camera", "Camera", false)) return;
  const float drag_speed = 0.005f * state.natural_speed;
  for (const auto& row : settings_table()) {
    if (group_of(row.key) != "camera") continue;
    const Camera before = state.document.scene.camera;
    if (!setting(ui, row, state.document, state.home, drag_speed)) continue;
    state.edited = true;
    if (std::string problem = camera_problem(state.document.scene.camera); !problem.empty()) {
      state.document.scene.camera = before;
      state.fail(ErrorCause::camera, std::move(problem));
    } else {
      state.settle(ErrorCause::camera);
    }
  }
  focus_rows(ui, state);
  ui.number("camera.speed", "move speed", state.speed_factor, 0.01f, 100.0f, "%.2f x", 1,
            "Speed of flight: 1 crosses the scene in four seconds (mouse wheel while a key flies).\nRestarts "
            "nothing.\nCtrl+click to type, double-click to reset.");
  const float quarter =
      std::floor((ImGui::GetContentRegionAvail().x - 3 * ImGui::GetStyle().ItemSpacing.x) / 4);
  constexpr struct {
    const char *name, *label, *tip;
    AxisView view;
  } kViews[] = {{"camera.front", "Front", "Along the front axis (number pad 1; Ctrl: back)", AxisView::front},
                {"camera.right", "Right", "From the right (number pad 3; Ctrl: left)", AxisView::right},
                {"camera.top", "Top", "From above (number pad 7; Ctrl: below)", AxisView::top}};
  for (const auto& entry : kViews) {
    if (ui.button(entry.name, entry.label, entry.tip, quarter)) state.axis_view_requested = entry.view;
    ImGui::SameLine();
  }
  if (ui.button("camera.frame", "Frame", "The selection, or the whole scene, into the picture (.)", quarter))
    state.frame_requested = true;
  if (ui.button("camera.reset", "Reset view", "The camera as the scene has it (Home)"))
    state.reset_view_requested = true;
  ImGui::SameLine();
  ImGui::TextDisabled("F over the picture focuses");
}

} // namespace candela
