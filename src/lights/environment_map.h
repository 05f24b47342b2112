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

#include "core/spectrum.h"
#include "lights/light_rows.h"
#include "lights/panorama.h"
#include "sampling/weighted_grid.h"

#include <array>
#include <memory>
#include <optional>

namespace candela {

/// What light sampling of a panorama is in proportion to.
enum class EnvironmentDensity {
  full, ///< the luminance
  /// The luminance above the mean. For estimates that combine it with BSDF sampling by MIS, which finds the
  /// rest (Karlik et al. 2019, "MIS Compensation"): all light samples go to a sun, none to its sky. On a ball
  /// under both (tests/bench/versus_cycles) relMSE x spp falls from 0.058 to 0.031.
  compensated,
};

class EnvironmentMap {
public:
  /// Throws Cancelled soon after `progress` is told to end; it may be null.
  EnvironmentMap(std::shared_ptr<const Panorama> panorama, EnvironmentMapping mapping,
                 const Progress* progress = nullptr);

  const std::shared_ptr<const Panorama>& panorama() const { return panorama_; }
  EnvironmentMapping mapping() const { return mapping_; }

  /// W/(m^2 sr) that arrives from the unit direction d: bilinear between texel centres, also across the edges
  /// of a cube's faces.
  Spectrum radiance(vec3 d) const;

  /// A direction and what is there.
  struct RadianceSample {
    vec3 direction{0}; ///< unit
    Spectrum radiance{0};
    float pdf = 0; ///< 1/sr
  };
  /// u in [0, 1)^2; nothing for a u outside of the disc of an angular map, or where nothing shines. The
  /// density is the interpolated luminance (of `compensated`: the interpolation of what texels have above the
  /// mean) times a factor that varies little: the solid angle of a texel over that of the place, as if the
  /// texel were as large everywhere.
  std::optional<RadianceSample> sample(vec2 u, EnvironmentDensity of = EnvironmentDensity::full) const;
  /// Where a direction is on the chart.
  struct Place {
    vec3 direction{0}; ///< unit
    int face = 0;      ///< 0 of an image that is no cube's
    vec2 q{0};         ///< of the face's square, in [0, 1)^2, y downwards
  };
  /// Finds the place of the unit direction d and sends for its texels, which lookup() will want: they come
  /// from anywhere in a large image.
  Place locate(vec3 d) const;
  /// radiance() and pdf() at once.
  RadianceSample lookup(const Place& at, EnvironmentDensity of = EnvironmentDensity::full) const;
  RadianceSample lookup(vec3 d, EnvironmentDensity of = EnvironmentDensity::full) const {
    return lookup(locate(d), of);
  }
  /// The density of sample(), 1/sr.
  float pdf(vec3 d, EnvironmentDensity of = EnvironmentDensity::full) const { return lookup(d, of).pdf; }

  /// Luminance over the sphere of what is sampled, W/m^2.
  float total_luminance(EnvironmentDensity of = EnvironmentDensity::full) const { return density(of).total; }
  std::size_t memory_bytes() const;

private:
  struct ChartPoint {
    int face;
    vec2 q;
  };
  /// Four texels.
  struct Corners {
    const vec3 *above, *below; ///< rows
    int left, right;
    vec2 f; ///< how far to the right and down
  };
  struct Footprint {
    std::array<vec3, 4> texels; ///< upper left, upper right, lower left, lower right
    vec2 f;                     ///< how far to the right and down
  };
  /// What is sampled: texels by their luminance above `dark`.
  struct Density {
    float dark = 0;
    float total = 0, per_luminance = 0; ///< W/m^2; texels over that
    WeightedGrid texels;                ///< by what each sends; a cube's faces one below the other
    std::vector<float> row_factor;      ///< latlong: factor() of a row's texels
  };

  ChartPoint chart_point(vec3 d) const;
  std::optional<vec3> direction(ChartPoint at) const;
  float per_steradian(ChartPoint at, vec3 d) const;
  const Density& density(EnvironmentDensity of) const {
    return of == EnvironmentDensity::compensated && compensated_.total > 0 ? compensated_ : full_;
  }

  void cut_faces(const Progress* progress);
  void pad_faces();
  int column(int x) const;
  const vec3* row(int face, int y) const;
  vec3 texel(int face, int x, int y) const { return row(face, y)[column(x)]; }
  Corners corners(int face, vec2 q) const;
  Footprint footprint(int face, vec2 q) const;
  Spectrum bilinear(int face, vec2 q) const;
  double texel_solid_angle(int x, int y) const;
  float factor(const Density& density, int x, int y) const;
  Density make_density(float dark, const Progress* progress) const;

  std::shared_ptr<const Panorama> panorama_;
  EnvironmentMapping mapping_;
  int faces_ = 1, width_ = 0, height_ = 0; ///< of each face, in texels
  Image padded_faces_;                     ///< cubes: with a border of one texel, one below the other
  Density full_, compensated_; ///< no total in compensated_: the panorama is too even to leave any out
};

} // namespace candela
