#pragma once
// Scenes for both renderers. They only use features that both support equally; possible differences are noted
// at each scene. There is no light but that of the scene's emitters.

#include "scene/document.h"

#include <string>
#include <vector>

namespace candela::versus {

struct VersusScene {
  std::string name;
  std::string description;
  Document document; ///< film of size x size pixels, the rest of the settings are the defaults
  int spp;           ///< of one render
};

/// The diffuse Cornell box of render_bench, lit by one rectangle.
VersusScene cornell_box(int size);

/// A bumpy grey ball of 20 x 4^level flat triangles under a panorama with a sun of the true size, 0.53
/// degrees.
///
/// The sun is part of the panorama, as in photographed ones, since Candela's directional light has no disc
/// and Cycles' sun lamp cannot be hit by camera rays; both importance-sample the picture and interpolate it
/// bilinearly.
VersusScene bumpy_ball(int size, int level);

/// Four metal plates of GGX roughness alpha = 0.01, 0.05, 0.1, 0.2, four emissive balls of equal power, a
/// diffuse floor and wall; after E. Veach, Robust Monte Carlo Methods for Light Transport Simulation (1997),
/// section 9.4.
///
/// The reflectance at normal incidence is 1, with which Schlick's approximation is 1 at all angles: Cycles'
/// Glossy BSDF (single scattering, as here) has no Fresnel term. In Blender 3.4 a point lamp of radius r is a
/// disc that faces the shading point, so that at the distance d its irradiance is less than a sphere's by r^2
/// / (d^2 + r^2); the balls are small and distant enough to keep this below 1 %. The camera sees none of
/// them, since Cycles' lamps are invisible.
VersusScene veach_plates(int size);

} // namespace candela::versus
