#pragma once
// The state of the probe, the histogram and the focus overlay; written by the Inspector.

#include "imaging/histogram.h"
#include "session/render_session.h"

#include <optional>
#include <string>

namespace candela {

struct InspectState {
  bool probe_visible = false;
  bool probe_frozen = false;        ///< the probe stays at its pixel
  std::optional<ivec2> probe_pixel; ///< of the film; none while the mouse is not over it
  std::optional<Pick> probe_pick;   ///< the surface under it

  bool histogram_open = false; ///< drawn in the last frame; it is computed only then
  std::shared_ptr<const LogHistogram> histogram;
  std::shared_ptr<const DisplayImage> histogram_of;

  bool focus_plane_visible = false;
  struct FocusMark {
    vec3 position{0};     ///< world space
    float view_depth = 0; ///< scene units
    double until = 0;     ///< time until which the mark is shown
  };
  std::optional<FocusMark> focus_mark;

  std::string bookmark_name; ///< typed in the panel
  int selected_bookmark = 0;
};

} // namespace candela
