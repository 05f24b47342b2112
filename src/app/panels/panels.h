#pragma once
// What is drawn over and beside the picture: the column of panels, bars, strips and overlays.

#include "app/compare/compare_layout.h"
#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// What is written over the pictures of a comparison: what they are, the divider, the legend of a difference.
void compare_overlay(Ui& ui, const CompareState& compare, const ComparePanes& panes,
                     bool difference_is_there);

/// What is needed at any time: undo, pause and the like; above the column.
void tool_bar(Ui& ui, ViewerState& state, vec2 position, vec2 size);

/// The column of all panels along the right edge of the window.
void panel_column(Ui& ui, ViewerState& state, vec2 position, vec2 size);

/// The line along the bottom: progress, speed, what is going on.
void status_line(Ui& ui, ViewerState& state, vec2 position, vec2 size);

/// The strips over the picture, at the top of `room`, that ask, and tell what is being loaded and what went
/// wrong; the rest of the window goes on working.
void message_strips(Ui& ui, ViewerState& state, vec2 position, vec2 room);

/// Every key, over the picture.
void help_overlay(Ui& ui, ViewerState& state, vec2 center, vec2 room);

/// Says over the picture what about it is not as it was rendered.
void picture_label(Ui& ui, const ViewerState& state, vec2 top_left);

/// One line over the picture: the hint of the first seconds, or a notice while the status line is hidden.
void floating_line(Ui& ui, const char* name, std::string_view text, vec2 bottom_center);

} // namespace candela
