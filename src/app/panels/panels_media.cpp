// The panel of the scene's media.

#include "app/panels/medium_picker.h"
#include "app/panels/panel_list.h"
#include "app/ui/item_list.h"
#include "scene/media_edits.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

namespace candela {

bool medium_field(Ui& ui, const ViewerState& state, const char* name, const char* label, std::string& medium,
                  std::string_view help) {
  const std::vector<MediumDesc>& media = state.document.scene.media;
  std::vector<std::string_view> names = {"none"};
  int chosen = 0;
  for (const MediumDesc& m : media) {
    names.push_back(m.name);
    if (m.name == medium) chosen = static_cast<int>(names.size()) - 1;
  }
  if (!ui.choice(name, label, chosen, names, help)) return false;
  medium = chosen == 0 ? std::string() : media[static_cast<std::size_t>(chosen) - 1].name;
  return true;
}

namespace {

/// The medium of that name as it was loaded, if its model, or that of its phase function, still is the same.
MediumDesc* home_of(ViewerState& state, const MediumDesc& medium, bool phase) {
  auto& home = state.home.scene.media;
  const auto known = std::ranges::find(home, medium.name, &MediumDesc::name);
  if (known == home.end()) return nullptr;
  const bool same = phase ? known->phase.model.index() == medium.phase.model.index()
                          : known->model.index() == medium.model.index();
  return same ? &*known : nullptr;
}

/// Of the medium, or of its phase function: the type, and the rows of that type.
template <class Owner, class Rows>
void typed_fields(Ui& ui, ViewerState& state, const char* prefix, std::string_view label,
                  const FieldInfo& types, Owner& owner, Owner* home, Rows rows) {
  auto type = static_cast<int>(owner.model.index());
  FieldContext of_type;
  of_type.label = label;
  if (ui.field(fmt::format("{}.type", prefix), types, &type, of_type)) {
    change_type(owner, type);
    state.edited = true;
    return; // the rows have changed
  }
  for (const auto& row : rows(owner)) {
    FieldContext context;
    context.initial = home != nullptr ? row.address(*home) : nullptr;
    state.edited |= ui.field(fmt::format("{}.{}", prefix, row.key), row, row.address(owner), context);
  }
}

void add_from_presets(Ui& ui, ViewerState& state) {
  static const std::vector<MediumDesc> presets = medium_presets();
  std::vector<std::string_view> names = {"choose"};
  for (const MediumDesc& preset : presets) names.push_back(preset.name);
  int chosen = 0;
  if (!ui.choice("media.add", "add", chosen, names, "Adds a medium; then choose what it fills") ||
      chosen == 0)
    return;
  state.selected_medium =
      static_cast<int>(add_medium(state.document.scene, presets[static_cast<std::size_t>(chosen) - 1]));
  state.edited = true;
}

std::string box_text(const Bounds3& box) {
  return fmt::format("{:.4g} {:.4g} {:.4g} to {:.4g} {:.4g} {:.4g}", box.lo.x, box.lo.y, box.lo.z, box.hi.x,
                     box.hi.y, box.hi.z);
}

/// The file of a medium that may have one.
void volume_file(Ui& ui, ViewerState& state, MediumDesc& medium) {
  const auto grid = medium_grid(medium);
  ui.readout("file", grid ? std::filesystem::path(grid->source).filename().string() : "none",
             "Densities, and perhaps temperatures and colours");
  if (grid) {
    ui.readout("cells", fmt::format("{} x {} x {}", grid->cells.x, grid->cells.y, grid->cells.z),
               "Of the file's grid");
    ui.readout("its box", box_text(grid->bounds), "Where the file says that its grid is");
  }
  const float button = 64 * ui.scale(), gap = ImGui::GetStyle().ItemSpacing.x;
  const std::string before = state.volume_input;
  const bool entered = ui.text("medium.file", "Path, or drop it here", state.volume_input, -button - gap);
  if (state.volume_input != before) state.settle(ErrorCause::open);
  ImGui::SameLine();
  const bool pressed =
      ui.button("medium.open", "Open", "Fills the box with this file (.vdb, .nvdb, .vol, .cvol)", button);
  if ((entered || pressed) && !state.volume_input.empty()) state.open_paths = {state.volume_input};
  if (!grid ||
      !ui.button("medium.box", "Box of the file", "Sets centre and size to the file's own box", 2 * button))
    return;
  take_box_of_file(medium);
  state.edited = true;
}

/// How far light goes, channel by channel.
void mean_free_path(Ui& ui, const MediumDesc& medium) {
  const Spectrum sigma_t = medium_extinction(medium);
  std::string text;
  for (int c = 0; c < 3; ++c)
    text += sigma_t[c] > 0 ? fmt::format("{}{:.3g}", c > 0 ? "  " : "", 1 / sigma_t[c])
                           : fmt::format("{}endless", c > 0 ? "  " : "");
  ui.readout(
      "mean free path", text,
      "How far light goes on the mean before it is scattered or absorbed: red, green, blue, in scene units");
}

/// What the selected medium fills.
void places_of(Ui& ui, ViewerState& state, const MediumDesc& medium) {
  SceneDesc& scene = state.document.scene;
  const bool object = state.selection.kind == Selection::Kind::object;
  const std::string name = medium.name; // the edit may move the list
  const float width = 140 * ui.scale();
  if (object &&
      ui.button("media.fill", "Fill the object",
                "Puts the medium into the selected object; a material that others have, too, is copied",
                width)) {
    const bool visible = fill_instance(scene, static_cast<std::size_t>(state.selection.index), name);
    if (!visible)
      state.notice =
          "No light enters this object: give it a material such as null, dielectric or rough_dielectric";
    state.edited = true;
  }
  if (object) ImGui::SameLine();
  if (ui.button("media.remove", "Remove", "Takes the medium out of the scene and of all that it fills",
                80 * ui.scale())) {
    remove_medium(scene, static_cast<std::size_t>(state.selected_medium));
    state.edited = true;
  }
}

} // namespace

void media_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.media", "Media", false)) return;
  SceneDesc& scene = state.document.scene;
  add_from_presets(ui, state);
  if (scene.media.empty()) {
    ImGui::TextDisabled("The scene has none.");
    return;
  }
  state.edited |= medium_field(ui, state, "scene.medium", "in the scene", scene.medium,
                               "Fills the scene wherever no body is: fog, haze");
  state.selected_medium = std::clamp(state.selected_medium, 0, static_cast<int>(scene.media.size()) - 1);
  item_list(ui, "list.media", scene.media.size(), -1, [&](std::size_t i) {
    if (ui.item(fmt::format("media/{}", i), scene.media[i].name.c_str(),
                static_cast<int>(i) == state.selected_medium))
      state.selected_medium = static_cast<int>(i);
  });
  const auto selected = static_cast<std::size_t>(state.selected_medium);
  MediumDesc& medium = scene.media[selected];
  ImGui::PushID(state.selected_medium);
  std::string name = medium.name;
  if (ui.text("medium.name", "Name; Enter renames it everywhere", name, -1) && name != medium.name) {
    if (rename_medium(scene, selected, name))
      state.edited = true;
    else
      state.notice = "Another medium has this name";
  }
  MediumDesc* home = home_of(state, medium, false);
  typed_fields(ui, state, "medium", "type", medium_type_field(), medium, home,
               [](const MediumDesc& m) { return medium_fields(m); });
  if (takes_grid(medium)) volume_file(ui, state, medium);
  MediumDesc* phase_home = home_of(state, medium, true);
  typed_fields(ui, state, "phase", "phase", phase_type_field(), medium.phase,
               phase_home != nullptr ? &phase_home->phase : nullptr,
               [](const PhaseDesc& p) { return phase_fields(p); });
  mean_free_path(ui, medium);
  places_of(ui, state, medium);
  ImGui::PopID();
}

} // namespace candela
