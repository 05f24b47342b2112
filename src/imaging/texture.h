#pragma once
// Pictures as textures keep them.

#include <cstdint>
#include <string>
#include <vector>

namespace candela {

/// An 8-bit sRGB picture that colours a surface; row 0 is the top, three bytes a texel.
struct Texture {
  std::string name;
  std::string source;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> srgb;
  bool operator==(const Texture&) const = default;
};

} // namespace candela
