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
  /// Relative differences of the means that the models themselves have, as the scene's comment says.
  double image_tolerance = 0.005, block_tolerance = 0.02;
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

/// A flat-shaded ball of rough glass (n = 1.5, GGX alpha = 0.09, single scattering) in the Cornell box.
///
/// Cycles 3.4 takes the Fresnel term of the surface's normal, we that of the facet's (Walter et al. 2007).
VersusScene rough_glass(int size);

/// Two balls of the principled material in the Cornell box: metal, and plastic.
///
/// Both are Disney's model of 2012; Cycles weighs the specular colour by the exact Fresnel curve of the index
/// 1.5, we by Schlick's for metals.
VersusScene principled_balls(int size);

/// A box of fog (albedo 0.9, Henyey-Greenstein g = 0.4, optical depth about 1 across) around a small lamp in
/// a shade, which throws a cone of light.
///
/// As a disc that faces the point, Cycles' point lamp is darker near by, see veach_plates().
VersusScene foggy_spot(int size);

/// Smoke in [-1, 1]^3, of the density
///     max(0, 1 - |p|^2) x max(0, 0.3 + sin(9 x + 4 y) cos(8 z - 3 x)),
/// which Cycles evaluates and marches through, and Candela has in a grid of 128^3 cells.
float smoke_density(vec3 p);
/// A ball of it (albedo 0.8, Henyey-Greenstein g = 0.3) over a floor, between a lamp of an area and a wall.
VersusScene smoke_ball(int size);

/// A ball with `strands` strands of brown hair (Chiang et al. 2016 in both) under the panorama with a sun.
///
/// Cycles has curves of Catmull and Rom through points of our B-splines. Where light scatters often it is up
/// to 30 % darker than we are in the colour that is absorbed most; Mitsuba 3.9.1 is 5 % brighter there than
/// we are, and agrees with us where it scatters once (tests/peers/mitsuba_curves.py).
VersusScene furry_ball(int size, int strands);

} // namespace candela::versus
