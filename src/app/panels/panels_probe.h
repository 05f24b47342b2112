#pragma once
// What lies over the picture and tells about it: the probe, the mark of the focus, the legend of false
// colours; and their rows in the panels.

#include "app/panels/viewer_state.h"
#include "app/tools/viewport.h"
#include "app/ui/widgets.h"
#include "render/camera/camera_view.h"

namespace candela {

/// Largest blur, in film pixels, that is called sharp: 1/500 of the picture's height, one pixel at least.
inline float sharp_blur(int film_height) { return std::max(1.0f, static_cast<float>(film_height) / 500); }

/// The values of the probed pixel and of what is seen there, in the upper left corner.
void probe_overlay(Ui& ui, ViewerState& state, const PixelRect& picture, vec2 top_left);

/// A cross where the lens was focused last, with the distance beside it, for a while.
void draw_focus_mark(Ui& ui, ViewerState& state, const PixelRect& picture, double now);

/// The colours of a picture in false colours, and what they mean; `bottom_left` of the room that it has.
void legend_overlay(Ui& ui, const ViewerState& state, vec2 bottom_left);

/// Rows of the camera panel: where it is sharp, whether the plane of focus is shown.
void focus_rows(Ui& ui, ViewerState& state);

} // namespace candela
