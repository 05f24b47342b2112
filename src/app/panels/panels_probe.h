#pragma once
// Overlays with information about the picture: the probe, the focus mark, the legend of false colours; and
// their rows in the panels.

#include "app/panels/viewer_state.h"
#include "app/tools/viewport.h"
#include "app/ui/widgets.h"
#include "render/camera/camera_view.h"

namespace candela {

/// Largest blur, in film pixels, that counts as sharp: 1/500 of the picture's height, at least one pixel.
inline float sharp_blur(int film_height) { return std::max(1.0f, static_cast<float>(film_height) / 500); }

/// The values of the probed pixel and of the surface there, in the upper left corner.
void probe_overlay(Ui& ui, ViewerState& state, const PixelRect& picture, vec2 top_left);

/// A cross at the last focus point, with its distance, for a short time.
void draw_focus_mark(Ui& ui, ViewerState& state, const PixelRect& picture, double now);

/// The legend of a picture in false colours; `bottom_left` of the room that it has.
void legend_overlay(Ui& ui, const ViewerState& state, vec2 bottom_left);

/// Rows of the camera panel: the distances in focus, and whether the plane of focus is shown.
void focus_rows(Ui& ui, ViewerState& state);

} // namespace candela
