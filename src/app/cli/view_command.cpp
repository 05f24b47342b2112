#include "app/cli/view_command.h"

#include "app/platform/streams.h"
#include "app/window/window_glfw.h"
#include "core/error.h"

#include <fmt/format.h>

#include <cstdio>

namespace candela {

int run_view(const SceneOptions& options, bool use_preferences) {
  // Checked before the scene is read, which may take long.
  if (!display_available())
    throw Error(ExitCode::display,
                "display: there is none to open a window on: set DISPLAY (or WAYLAND_DISPLAY), or "
                "use `candela render SCENE -o FILE`");
  LoadedScene loaded = load_scene(options);
  ViewerOptions viewer;
  viewer.document = std::move(loaded.document);
  viewer.files = std::move(loaded.files);
  viewer.scene_path = options.path;
  viewer.threads = options.threads;
  viewer.reading = {options.allow_outside};           // also for scenes opened later
  for (const std::string& setting : options.settings) // a size on the command line fixes the film
    if (setting.starts_with("film.width=") || setting.starts_with("film.height=")) viewer.fit_film = false;
  if (use_preferences) viewer.preferences_path = default_preferences_path();
  if (!viewer.preferences_path.empty()) {
    std::string warning;
    viewer.preferences = read_preferences(viewer.preferences_path, warning);
    if (!warning.empty()) viewer.warnings.push_back(warning), say("candela: warning: {}\n", warning);
  }
  for (const Warning& w : loaded.warnings) viewer.warnings.push_back(w.text);
  run_window(std::move(viewer));
  return 0;
}

} // namespace candela
