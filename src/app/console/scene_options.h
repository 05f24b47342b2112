#pragma once
// Options of all commands that read a scene.

#include "io/scene_reader.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

struct SceneOptions {
  std::string path;                    ///< empty: the Cornell box
  std::optional<std::string> bookmark; ///< whose camera is used
  std::vector<std::string> settings;   ///< KEY=VALUE, applied in order
  bool allow_outside = false;
  int threads = 0; ///< 0: every core
};

/// Parses exactly `n` integers separated by `separator`, the value of an option such as --size. `form`
/// describes the syntax in the usage error.
std::vector<int> integers(const std::string& text, char separator, std::size_t n, std::string_view option,
                          std::string_view form);

/// Reads the scene, prints its warnings to stderr, applies the bookmark's camera and then the settings.
LoadedScene load_scene(const SceneOptions& options);

} // namespace candela
