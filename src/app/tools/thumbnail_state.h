#pragma once
// Pictures of materials for the panels, and which of them are on the screen.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace candela {

struct ThumbnailState {
  std::vector<unsigned> textures;    ///< the driver's, of the scene's materials by index; 0: none yet
  std::vector<std::string> problems; ///< parallel: why there is none; empty: nothing is wrong
  std::set<std::size_t> drawn;       ///< materials whose pictures this frame shows: those are made
};

} // namespace candela
