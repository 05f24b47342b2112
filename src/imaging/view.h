#pragma once
// The quantities that a picture can show.

namespace candela {

/// The quantity of a pixel: radiance, properties of the first surface, then statistics of the render.
enum class View : int {
  radiance,
  albedo,
  normal,           ///< shading normal
  geometric_normal, ///< by the winding of triangles
  depth,
  optical_depth, ///< of the media between the camera and the first surface
  uv,
  material,
  bvh_cost,    ///< nodes and primitives tested for the camera ray
  depth_share, ///< shares of the radiance by path length
  light_share, ///< shares of the direct light by sampling strategy
  variance,
  samples,
  nonfinite
};
/// The view whose samples a film must hold for this one: switching between views of the same samples restarts
/// nothing.
constexpr View accumulated_view(View view) {
  return view == View::variance || view == View::samples || view == View::nonfinite ? View::radiance : view;
}

/// Whether the view is scalar, with three equal channels.
bool is_scalar_view(View view);

} // namespace candela
