#pragma once
// The pictures that environment lights show.

#include "imaging/image.h"

#include <string>
#include <vector>

namespace candela {

/// The radiance that comes from all around, as a picture; six faces of a cube are stacked in the order of
/// their files. Pixels are finite and not negative.
struct Panorama {
  std::string name;
  std::vector<std::string> sources; ///< the file, or those of the six faces; may be empty
  Image image;
  bool operator==(const Panorama&) const = default;
};

} // namespace candela
