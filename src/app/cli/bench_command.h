#pragma once
// `candela bench interactive`: input latency, and the shares of the cores meanwhile.

#include "app/console/scene_options.h"

namespace candela {

struct InteractiveBenchOptions {
  SceneOptions scene;
  std::optional<std::string> size; ///< WxH of the window; else 1280x720
  std::optional<int> repeats;
  std::optional<double> seconds;
  std::optional<std::string> json; ///< file to write
  bool short_run = false;
  bool offscreen = false; ///< even where there is a display
  bool quiet = false;
};

/// Measures in a window, or in memory where there is no display; prints a table with the targets, met or
/// missed. Returns 0 for any measurement.
int run_interactive_bench(const InteractiveBenchOptions& options);

} // namespace candela
