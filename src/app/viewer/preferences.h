#pragma once
// Preferences that the window stores between runs: size, layout, recent files.

#include "core/math.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace candela {

struct Preferences {
  ivec2 window{1280, 720}; ///< at scale 1
  float text_zoom = 1;
  float speed_factor = 1;
  bool panels_visible = true;
  bool overlays_visible = true;
  std::map<std::string, bool> open_sections; ///< by the widget's name
  std::vector<std::string> recent;           ///< absolute paths, the most recent first
  bool operator==(const Preferences&) const = default;
};

/// Converts a window's size to and from scale 1, rounded such that storing and opening it repeatedly keeps
/// the size.
ivec2 size_at_scale_one(ivec2 framebuffer, float scale);
ivec2 size_at_scale(ivec2 size, float scale);

/// $XDG_CONFIG_HOME/candela/preferences.json, or below ~/.config; empty if neither is set.
std::filesystem::path default_preferences_path();

/// The valid values of the file, defaults for the rest. `warning` names ignored values; a missing file gives
/// no warning.
Preferences read_preferences(const std::filesystem::path& path, std::string& warning);

/// Creates the folder if needed and writes the file atomically. output_error if it cannot be written.
void write_preferences(const Preferences& preferences, const std::filesystem::path& path);

/// Moves or adds the file to the front of the list, which is limited to about ten.
void add_recent(Preferences& preferences, const std::string& path);

} // namespace candela
