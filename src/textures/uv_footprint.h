#pragma once
// How much of a texture a lookup stands for.

#include "core/math.h"

namespace candela {

/// A parallelogram, or the ellipse in it, about a place in texture coordinates: two axes, whole.
struct UvFootprint {
  vec2 major{0}, minor{0};
};

/// Where a texture is looked up. What has no footprint is a point.
struct TexturePoint {
  vec2 uv{0};
  UvFootprint footprint{};

  TexturePoint(vec2 place) : uv(place) {}
  TexturePoint(vec2 place, const UvFootprint& area) : uv(place), footprint(area) {}
  bool is_point() const { return footprint.major == vec2(0) && footprint.minor == vec2(0); }
};

} // namespace candela
