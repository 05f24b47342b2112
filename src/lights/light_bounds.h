#pragma once
// What choosing among lights knows of one, or of several: where they are and which way they shine.

#include "core/bounds.h"

namespace candela {

/// Lights within a box, whose normals are within theta_o of an axis and which shine up to theta_e off their
/// normals (Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
/// section 4.1).
struct LightBounds {
  Bounds3 box;
  vec3 center{0};
  float radius = 0; ///< of a sphere about the centre that holds them
  vec3 axis{0, 0, 1};
  float theta_o = 0, theta_e = 0; ///< radians, in [0, pi] and [0, pi/2]
  double intensity = 0;           ///< W/sr in luminance, towards where they shine strongest
  bool two_sided = false;
};

/// So much wider are cones made (radians), lest rounding take away light that just grazes them.
inline constexpr float kBoundsConeSlack = 1e-3f;

/// Of a ball that shines alike in all directions; intensity in W/sr, luminance.
LightBounds omnidirectional_bounds(vec3 center, float radius, double intensity);

/// Of both together.
LightBounds merge(const LightBounds& a, const LightBounds& b);

/// How much the lights may differ in what they contribute to a point, but for the choice of an axis to split:
/// the surface area orientation heuristic (section 4.4), intensity times the measures of their directions and
/// of their extent. The box's squared diagonal stands for its area, which vanishes for lights in a row.
double saoh_cost(const LightBounds& bounds);

} // namespace candela
