#pragma once
// Float pictures, as values.

#include "core/math.h"

#include <cstddef>
#include <vector>

namespace candela {

/// A float picture: linear Rec. 709, row 0 is the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<vec3> pixels;

  const vec3& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  vec3& at(int x, int y) { return const_cast<vec3&>(static_cast<const Image&>(*this).at(x, y)); }
  bool operator==(const Image&) const = default;
};

} // namespace candela
