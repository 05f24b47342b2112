#pragma once
// The radiance of a panorama by direction, and a density that follows it.
//
// Axes, in the panorama's own space (a light's `up` and `rotation` turn it); images are never mirrored as
// seen from the inside:
//
// - latlong: the top is +y, the bottom -y, the centre +z; to the right lie -x, -z at both edges, and +x, so
//   that u = atan2(x, -z) / 2 pi, v = acos(y) / pi. This is Mitsuba's envmap.
// - angular: Debevec's light probes. The centre is -z, to the right lies +x, upwards +y; the angle to -z
//   grows evenly from there to the circle that the image's sides touch, which is +z.
// - cross: four by three squares (3 : 4 if upright). In the middle -z, around it +y above, -y below, -x on
//   the left, +x on the right; +z is right of +x, or below -y and upside down if the cross is upright.
// - faces: one below the other +x, -x, +y, -y, +z, -z, each as it is in the horizontal cross.
//
// An image whose sides have other proportions is stretched.

#include "sampling/distribution.h"
#include "scene/scene_desc.h"

#include <array>

namespace candela {

class EnvironmentMap {
public:
  EnvironmentMap(std::shared_ptr<const Panorama> panorama, EnvironmentMapping mapping);

  const std::shared_ptr<const Panorama>& panorama() const { return panorama_; }
  EnvironmentMapping mapping() const { return mapping_; }

  /// W/(m^2 sr) that arrives from the unit direction d: bilinear between texel centres, also across the edges
  /// of a cube's faces.
  vec3 radiance(vec3 d) const;

  /// A unit direction, u in [0, 1)^2; nothing for a u outside of the disc of an angular map. The density is
  /// constant over a cell of the image (at most kMaxCells a side) but for the mapping's own distortion, and
  /// positive wherever the interpolated radiance is.
  std::optional<vec3> sample(vec2 u) const;
  /// Its density, 1/sr.
  float pdf(vec3 d) const;

  /// Luminance over the sphere, W/m^2.
  float total_luminance() const { return total_luminance_; }
  std::size_t memory_bytes() const;

private:
  static constexpr int kMaxCells = 2048;

  /// A point of the unit square whose cells are sampled; of a cube the faces' squares, one below the other.
  struct ChartPoint {
    vec2 p{0};           ///< in [0, 1)^2
    float per_steradian; ///< area of the chart over solid angle there
  };
  ChartPoint chart_point(vec3 d) const;
  std::optional<vec3> direction(vec2 p) const;

  void cut_faces();
  void pad_faces();
  vec3 texel(int face, int x, int y) const;
  vec3 lookup(int face, vec2 q) const;
  double cell_solid_angle(int x, int y) const;
  void build_distribution();

  std::shared_ptr<const Panorama> panorama_;
  EnvironmentMapping mapping_;
  int faces_ = 1, width_ = 0, height_ = 0; ///< of each face, in texels
  Image padded_faces_;                     ///< cubes: with a border of one texel, one below the other
  PiecewiseConstant2D distribution_;
  std::size_t cells_ = 0;
  float total_luminance_ = 0;
};

} // namespace candela
