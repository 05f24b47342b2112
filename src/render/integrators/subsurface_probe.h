#pragma once
// Where light that enters a surface leaves it again, by a diffusion profile: King, Kulla, Conty & Fajardo
// 2013, "BSSRDF Importance Sampling". The distance of a profile is sampled on a disc about the entry point,
// whose points are projected to the surface along the disc's axis.

#include "accel/accel.h"
#include "bsdf/subsurface.h"
#include "render/integrators/ray_counts.h"
#include "render/world/render_scene.h"
#include "render/world/surface_interaction.h"

#include <optional>
#include <vector>

namespace candela {

/// Where light enters.
struct SubsurfacePoint {
  vec3 position;
  vec3 normal; ///< unit, of shading
  float side;  ///< > 0: from the side of the geometric normal; there it leaves
  float time;
  Hit hit;
};

/// Where it leaves.
struct SubsurfaceExit {
  SurfaceInteraction surface;
  vec3 normal;     ///< unit, of shading, on the side of the geometric normal
  float side;      ///< that of the entry
  Spectrum weight; ///< R(distance) over the density of the point, with every choice in it
  Subsurface bsdf; ///< there
};

/// For one thread; keep it, for it keeps its memory.
class SubsurfaceProbe {
public:
  /// A random exit point; nothing where none was found, which is a sample of value 0. Those on surfaces of
  /// the same material and instance count. `throughput` of the path, by which a channel's profile is chosen.
  /// probe_u.x chooses channel and axis, point_u the place on the disc, and probe_u.y one of the hits.
  std::optional<SubsurfaceExit> sample(const RenderScene& scene, const SubsurfacePoint& entry,
                                       const Subsurface& bsdf, Spectrum throughput, vec2 probe_u,
                                       vec2 point_u, RayCounts& counts);

private:
  struct Found {
    Ray ray;
    Hit hit;
  };
  void find(const RenderScene& scene, const SubsurfacePoint& entry, Ray ray, RayCounts& counts);
  template <class Profile>
  std::optional<SubsurfaceExit> sample_by(const Profile& profile, const RenderScene& scene,
                                          const SubsurfacePoint& entry, const Subsurface& bsdf,
                                          Spectrum channels, vec2 probe_u, vec2 point_u, RayCounts& counts);

  std::vector<Found> found_;
};

} // namespace candela
