#pragma once
// Views to come back to: what the Bookmarks panel and the number keys do.

#include "app/panels/viewer_state.h"

namespace candela {

/// Looks through the bookmark's camera, if there is one of that number.
void go_to_bookmark(ViewerState& state, std::size_t number);

/// Puts the camera into the bookmark of that number, or into a new one at the end where there is none.
void store_bookmark(ViewerState& state, std::size_t number);

/// `wish`, or with a number behind it where a bookmark other than `except` has that name.
std::string free_bookmark_name(const std::vector<Bookmark>& bookmarks, const std::string& wish,
                               std::size_t except);

} // namespace candela
