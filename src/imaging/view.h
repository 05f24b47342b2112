#pragma once
// What a picture shows.

namespace candela {

/// What a pixel shows. The first five rows of names are properties of the first surface; the rest is what the
/// render knows of itself.
enum class View : int {
  radiance,
  albedo,
  normal,           ///< shading normal
  geometric_normal, ///< by the winding of triangles
  depth,
  uv,
  material,
  bvh_cost,    ///< nodes and primitives that the camera ray tests
  depth_share, ///< of the radiance, by path length
  light_share, ///< of the direct light, by the strategy that found it
  variance,
  samples,
  nonfinite
};
/// The view whose samples a film must hold to show this one: switching between views of the same samples
/// restarts nothing.
constexpr View accumulated_view(View view) {
  return view == View::variance || view == View::samples || view == View::nonfinite ? View::radiance : view;
}

/// Whether a pixel of the view is one number, in three equal channels, rather than a colour.
bool is_scalar_view(View view);

} // namespace candela
