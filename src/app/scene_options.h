#pragma once
// What every command that takes a scene shares.

#include "io/scene_reader.h"

#include <optional>
#include <string>
#include <vector>

namespace candela {

struct SceneOptions {
  std::string path;                    ///< empty: the Cornell box
  std::optional<std::string> bookmark; ///< whose camera is used
  std::vector<std::string> settings;   ///< KEY=VALUE, applied in order
  bool allow_outside = false;
  int threads = 0; ///< 0: every core
};

/// Reads the scene, prints its warnings to stderr, goes to the bookmark and applies the settings over what
/// the file says.
LoadedScene load_scene(const SceneOptions& options);

} // namespace candela
