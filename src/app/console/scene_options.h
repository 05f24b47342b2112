#pragma once
// What every command that takes a scene shares.

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

/// Exactly `n` integers with `separator` between them: the value of an option such as --size. `form` tells
/// how it is written; a usage error if it is not.
std::vector<int> integers(const std::string& text, char separator, std::size_t n, std::string_view option,
                          std::string_view form);

/// Reads the scene, prints its warnings to stderr, goes to the bookmark and applies the settings over what
/// the file says.
LoadedScene load_scene(const SceneOptions& options);

} // namespace candela
