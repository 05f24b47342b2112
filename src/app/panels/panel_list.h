#pragma once
// The panels of the column, from top to bottom. Each draws its section with Ui into the current ImGui window
// and edits the state's Document. Each panel is implemented in a file of its own and listed here.

#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

void statistics_panel(Ui& ui, ViewerState& state);
void compare_panel(Ui& ui, ViewerState& state);
void display_panel(Ui& ui, ViewerState& state);
void inspect_panel(Ui& ui, ViewerState& state);
void camera_panel(Ui& ui, ViewerState& state);
void bookmarks_panel(Ui& ui, ViewerState& state);
/// Every row of the settings table that is not the camera's or the display's, by group.
void render_panel(Ui& ui, ViewerState& state);
/// Objects: their list, and the selected object's transform and materials.
void objects_panel(Ui& ui, ViewerState& state);
void materials_panel(Ui& ui, ViewerState& state);
void textures_panel(Ui& ui, ViewerState& state);
/// Media: their values, and what they fill.
void media_panel(Ui& ui, ViewerState& state);
void lights_panel(Ui& ui, ViewerState& state);
void scenes_panel(Ui& ui, ViewerState& state);

using DrawPanel = void (*)(Ui&, ViewerState&);
inline constexpr DrawPanel kPanels[] = {
    statistics_panel, compare_panel, display_panel, inspect_panel,   camera_panel,
    bookmarks_panel,  render_panel,  objects_panel, materials_panel, textures_panel,
    media_panel,      lights_panel,  scenes_panel,
};

} // namespace candela
