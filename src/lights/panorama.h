#pragma once
// The images of environment lights.

#include "imaging/image.h"

#include <string>
#include <vector>

namespace candela {

/// Incident radiance from all directions as an image; the six faces of a cube are stacked in the order of
/// their files. Pixels are finite and not negative.
struct Panorama {
  std::string name;
  std::vector<std::string> sources; ///< the file, or those of the six faces; may be empty
  Image image;
  bool operator==(const Panorama&) const = default;
};

/// What is wrong with its pixels, all of which are read: "cause; remedy"; empty where all is well. Readers
/// guarantee that there is nothing.
std::string panorama_problem(const Panorama& panorama);

} // namespace candela
