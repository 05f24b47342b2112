#pragma once
// The column of panels, and the bars, strips and overlays around and over the picture.

#include "app/compare/compare_layout.h"
#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// Labels over the pictures of a comparison, the divider, the legend of a difference.
void compare_overlay(Ui& ui, const CompareState& compare, const ComparePanes& panes,
                     bool difference_is_there);

/// The tools above the column: undo, pause and the like.
void tool_bar(Ui& ui, ViewerState& state, vec2 position, vec2 size);

/// The column of all panels along the right edge of the window.
void panel_column(Ui& ui, ViewerState& state, vec2 position, vec2 size);

/// The status line along the bottom: progress, speed, activity.
void status_line(Ui& ui, ViewerState& state, vec2 position, vec2 size);

/// The strips over the picture, at the top of `room`: questions, loading progress and errors. They are not
/// modal.
void message_strips(Ui& ui, ViewerState& state, vec2 position, vec2 room);

/// The help: all keys, over the picture.
void help_overlay(Ui& ui, ViewerState& state, vec2 center, vec2 room);

/// A label over the picture for what is shown differently from the render.
void picture_label(Ui& ui, const ViewerState& state, vec2 top_left);

/// One line over the picture: the initial hint, or a notice while the status line is hidden.
void floating_line(Ui& ui, const char* name, std::string_view text, vec2 bottom_center);

} // namespace candela
