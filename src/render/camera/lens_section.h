#pragma once
// A lens cut along its axis, as drawings show it, and how sharply it draws a point.

#include "render/camera/lens_system.h"

namespace candela {

/// Points are (z, x) of lens space (class LensSystem), millimetres.
struct LensSection {
  std::vector<std::vector<vec2>> elements; ///< closed outlines of the glasses
  float stop_z = 0, stop_radius = 0;       ///< as it is set
  float stop_rim = 0;                      ///< to which its blades reach
  float film_z = 0, film_radius = 0;
};
LensSection lens_section(const LensSystem& lens);

/// The way of a ray from the film: its points at the film, at the interfaces and, if it passes, `beyond`
/// millimetres before the first of them.
struct LensPath {
  std::vector<vec2> points;
  bool passes = false;
};
/// `count` rays from the film point at the height x, evenly spread over the last interface's opening.
std::vector<LensPath> lens_paths(const LensSystem& lens, float x, int count, float beyond);

/// Diameter in millimetres of the spot that a point on the axis, at that distance in millimetres from the
/// entrance pupil, makes on the film: of the rays in one plane, so with the lens's aberrations.
float lens_blur(const LensSystem& lens, float distance);
/// Of a thin lens of the same focal length, aperture and distance of focus: f^2 |d - s| / (N d (s - f)).
float thin_lens_blur(const LensSystem& lens, float distance);

} // namespace candela
