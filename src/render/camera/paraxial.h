#pragma once
// Rays near the axis of a lens: height and slope, linear through every interface (Smith 2000, "Modern Optical
// Engineering", section 2.6).

#include "render/camera/lens_surface.h"

#include <span>

namespace candela {

struct ParaxialRay {
  double height; ///< mm off the axis, at the plane z
  double slope;  ///< of the height per millimetre of way, whichever way it goes
  double z;

  /// Where it crosses the axis.
  double axis_crossing(bool to_scene) const { return z - (to_scene ? 1 : -1) * height / slope; }
};

inline void move_paraxial(ParaxialRay& ray, double z, bool to_scene) {
  ray.height += ray.slope * (to_scene ? z - ray.z : ray.z - z);
  ray.z = z;
}

/// Through `surfaces`, which are listed from the film to the scene, in the order in which the ray meets them.
inline ParaxialRay trace_paraxial(std::span<const LensSurface<double>> surfaces, ParaxialRay ray,
                                  bool to_scene) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const LensSurface<double>& s = surfaces[to_scene ? i : surfaces.size() - 1 - i];
    move_paraxial(ray, s.z, to_scene);
    const double before = to_scene ? s.eta_film : s.eta_scene, after = to_scene ? s.eta_scene : s.eta_film;
    const double curvature = to_scene ? s.curvature : -s.curvature; // positive: the centre lies ahead
    ray.slope = (before * ray.slope - ray.height * (after - before) * curvature) / after;
  }
  return ray;
}

} // namespace candela
