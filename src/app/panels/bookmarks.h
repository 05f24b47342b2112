#pragma once
// Bookmarks of views: the actions of the Bookmarks panel and the number keys.

#include "app/panels/viewer_state.h"

namespace candela {

/// Sets the camera to that of the bookmark, if there is one of that number.
void go_to_bookmark(ViewerState& state, std::size_t number);

/// Stores the camera in the bookmark of that number, or in a new one at the end.
void store_bookmark(ViewerState& state, std::size_t number);

/// `wish`, with a number appended if a bookmark other than `except` has that name.
std::string free_bookmark_name(const std::vector<Bookmark>& bookmarks, const std::string& wish,
                               std::size_t except);

} // namespace candela
