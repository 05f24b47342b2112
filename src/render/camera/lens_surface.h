#pragma once
// One interface of a lens and how a ray crosses it.

#include "core/math.h"

namespace candela {

/// In lens space (lens_system.h), millimetres. Real is float to render, double to set the lens up.
template <class Real>
struct LensSurface {
  Real z;                   ///< of its vertex
  Real curvature;           ///< 1 / radius; positive: the centre is towards the scene
  Real eta_film, eta_scene; ///< refractive indices on either side
  Real radius;              ///< of the clear opening
  bool stop;
};

/// Moves a ray of unit direction to the surface and refracts it there. False where it misses the opening, is
/// reflected totally or does not come from where the surface before it is. Without `clip` openings let
/// everything pass. p is then on the surface's sphere.
///
/// With the vertex as origin and p on its plane the sphere is k |q|^2 - 2 q.z = 0, so that with
/// G = d.z - k p.d the way to it is k |p|^2 / (G + sqrt(G^2 - k^2 |p|^2)): no digits are lost where the
/// surface is nearly flat, and the root is the one on the vertex's side (Welford 1986, "Aberrations of
/// Optical Systems", section 4.3).
template <bool to_scene, class Real>
bool cross_lens_surface(const LensSurface<Real>& s, glm::vec<3, Real>& p, glm::vec<3, Real>& d,
                        bool clip = true) {
  constexpr Real sign = to_scene ? 1 : -1;
  if (!(d.z * sign > 0)) return false;
  const Real k = s.curvature;
  const Real to_plane = (s.z - p.z) / d.z;
  Real x = p.x + to_plane * d.x, y = p.y + to_plane * d.y;
  const Real r2 = x * x + y * y, g = d.z - k * (x * d.x + y * d.y);
  const Real cos2 = g * g - k * k * r2; // of the angle to the normal, where they meet
  if (!(cos2 >= 0)) return false;
  const Real cosine = std::sqrt(cos2), root = sign * cosine;
  const Real t = g * sign >= 0 ? k * r2 / (g + root) : (g - root) / k;
  if (to_plane + t < 0) return false;
  x += t * d.x;
  y += t * d.y;
  const Real z = t * d.z;
  p = {x, y, s.z + z};
  if (!(k * z < 1)) return false; // the far side of the sphere
  if (clip && x * x + y * y > s.radius * s.radius) return false;
  if (s.eta_film == s.eta_scene) return true;
  const Real ratio = to_scene ? s.eta_film / s.eta_scene : s.eta_scene / s.eta_film;
  const Real cos2_after = 1 - ratio * ratio * (1 - cos2);
  if (!(cos2_after >= 0)) return false;
  const glm::vec<3, Real> normal(-k * x * sign, -k * y * sign, (1 - k * z) * sign); // unit, along the ray
  d = ratio * d + (std::sqrt(cos2_after) - ratio * cosine) * normal;
  return true;
}

} // namespace candela
