#pragma once
// One ray for the hand: what lies under a pixel.

#include "scene/document.h"

#include <optional>
#include <vector>

namespace candela {

class RenderScene;

struct Pick {
  vec3 position{0};               ///< world space
  vec3 geometric_normal{0, 0, 1}; ///< world space, unit, on the side of the camera
  float distance = 0;             ///< from where the camera's ray begins
  float view_depth = 0;           ///< distance along the view axis: what focus_distance means
  vec2 uv{0};                     ///< texture coordinates, as View::uv shows them but for their whole part
  int instance = -1;              ///< index into SceneDesc::instances
  int material = -1;              ///< index into SceneDesc::materials
};

/// The first surface under the centre of a pixel (film coordinates in pixels, top-left origin): of the camera
/// of time 0, whose pose tools edit, and where objects are when the shutter opens.
std::optional<Pick> pick(const RenderScene& scene, const Document& document, vec2 film_position);

/// View depths under a lattice of pixels, as a pinhole sees them.
struct DepthMap {
  int width = 0; ///< of the map
  int height = 0;
  std::vector<float> depth; ///< row 0 is the top; infinity where there is no surface
};

/// Of every `stride`-th pixel in both directions, at the middle of the square of pixels that it stands for.
DepthMap depth_map(const RenderScene& scene, const Document& document, int stride);

} // namespace candela
