#pragma once
// What the window keeps between runs: its size, its layout, recent files.

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
  std::vector<std::string> recent;           ///< absolute paths, the last one first
  bool operator==(const Preferences&) const = default;
};

/// What a window has at scale 1, and what it has of it at another scale: rounded, so that a window
/// keeps its size however often it is stored and opened again.
ivec2 size_at_scale_one(ivec2 framebuffer, float scale);
ivec2 size_at_scale(ivec2 size, float scale);

/// $XDG_CONFIG_HOME/candela/preferences.json, or below ~/.config; empty where there is neither.
std::filesystem::path default_preferences_path();

/// The valid values of the file, defaults for the rest. `warning` names what was ignored; a missing file
/// gives none.
Preferences read_preferences(const std::filesystem::path& path, std::string& warning);

/// Makes the folder if need be; the file appears whole or not at all. output_error if it cannot be written.
void write_preferences(const Preferences& preferences, const std::filesystem::path& path);

/// Puts the file at the front of the list, which has each once and at most some ten.
void add_recent(Preferences& preferences, const std::string& path);

} // namespace candela
