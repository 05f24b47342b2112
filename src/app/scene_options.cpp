#include "app/scene_options.h"

#include "app/data_file.h"
#include "core/error.h"

#include <fmt/format.h>

#include <cstdio>

namespace candela {

LoadedScene load_scene(const SceneOptions& options) {
  std::string path = options.path.empty() ? find_data_file("scenes/cornell_box.json").string() : options.path;
  LoadedScene scene = read_scene(path, {options.allow_outside});
  for (const Warning& w : scene.warnings)
    fmt::print(stderr, "candela: warning: {}{}\n", w.text,
               w.count > 1 ? fmt::format(" ({} times)", w.count) : "");
  for (const std::string& s : options.settings) apply_setting(scene.document, s);
  if (auto problem = document_problem(scene.document); !problem.empty())
    throw Error(ExitCode::bad_input, fmt::format("{}: {}", path, problem));
  return scene;
}

} // namespace candela
