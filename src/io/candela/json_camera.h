#pragma once
// Cameras and bookmarks in Candela JSON: the rows of the settings table below "camera.".

#include "io/candela/json_tree.h"
#include "scene/scene_desc.h"

namespace candela {

/// Reads an object of the camera's values; missing ones are those of a default camera. Throws input_error for
/// an unknown key, a value that does not fit its row, or a view without direction; `element` names it in the
/// message.
Camera read_json_camera(JsonValue object, const std::string& element);

/// [{"name": …, "camera": {…}}, …]. Throws input_error for a missing, empty or repeated name, limit_error for
/// more than kMaxBookmarks.
std::vector<Bookmark> read_json_bookmarks(JsonValue array);

inline constexpr std::uint32_t kMaxBookmarks = 10000;

/// The members that differ from a default camera's, and the bookmarks as objects; they read back to the same
/// bits.
std::vector<std::string> json_camera_members(const Camera& camera);
std::vector<std::string> json_bookmarks(const std::vector<Bookmark>& bookmarks);

} // namespace candela
