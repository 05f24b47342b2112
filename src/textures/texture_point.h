#pragma once
// Where a texture is looked up, and how much of it the lookup stands for.

#include "core/math.h"

#include <optional>

namespace candela {

/// A parallelogram, or the ellipse in it, about a place in texture coordinates: two axes, whole.
struct UvFootprint {
  vec2 major{0}, minor{0};
};

/// What a surface knows of a point beside its texture coordinates. In the object's space, scene units before
/// its transform.
struct SurfacePlace {
  vec3 position{0}, normal{0, 0, 1};   ///< the normal is the shading one, unit
  vec3 dpdu{1, 0, 0}, dpdv{0, 1, 0};   ///< derivatives by the texture coordinates, or of unit length
  vec3 vertex_color{1}, face_color{1}; ///< linear Rec. 709; white where the mesh has none
};

/// Where a texture is looked up. What has no footprint is a point. The place is there where a texture asks
/// for it (SurfaceMaterial::asks_place).
struct TexturePoint {
  vec2 uv{0};
  UvFootprint footprint{};
  std::optional<SurfacePlace> place;

  TexturePoint(vec2 coordinates) : uv(coordinates) {}
  TexturePoint(vec2 coordinates, const UvFootprint& area) : uv(coordinates), footprint(area) {}
  bool is_point() const { return footprint.major == vec2(0) && footprint.minor == vec2(0); }
  /// Beside this point by so much in texture coordinates.
  TexturePoint moved(vec2 step) const {
    TexturePoint out = *this;
    out.uv += step;
    if (out.place) out.place->position += step.x * out.place->dpdu + step.y * out.place->dpdv;
    return out;
  }
};

} // namespace candela
