#pragma once
// `candela bench interactive`: input latency and CPU usage.

#include "app/console/scene_options.h"

namespace candela {

struct InteractiveBenchOptions {
  SceneOptions scene;
  std::optional<std::string> size; ///< WxH of the window; default 1280x720
  std::optional<int> repeats;
  std::optional<double> seconds;
  std::optional<std::string> json; ///< file to write
  bool short_run = false;
  bool offscreen = false; ///< even where there is a display
  bool quiet = false;
};

/// Measures in a window, or off screen if there is no display; prints a table that says which targets are
/// met. Returns 0 whether they are or not.
int run_interactive_bench(const InteractiveBenchOptions& options);

} // namespace candela
