#pragma once
// The lesson `warps`: where the maps of sampling/warp.h take the unit square, and whether the density that
// they claim is the one that they have.

#include "core/fields.h"
#include "lab/histogram.h"
#include "lab/source.h"
#include "sampling/spherical_rectangle.h"

namespace candela {

enum class Warp : int {
  disc,
  sphere,
  hemisphere,
  cosine_hemisphere,
  cone,
  triangle,
  spherical_rectangle,
  gaussian
};

struct WarpOptions {
  Warp warp = Warp::cosine_hemisphere;
  float cone_angle = radians(30.0f); ///< of cone: from its axis to its edge
  int grid = 16;                     ///< cells a side of the histogram
  bool operator==(const WarpOptions&) const = default;
};
std::span<const Field<WarpOptions>> warp_fields();
/// Whether the warp looks at the option of this key.
bool warp_uses(Warp warp, std::string_view key);

/// One warp with its density and a chart of its domain.
class WarpMap {
public:
  explicit WarpMap(const WarpOptions& options);

  /// Where u in [0, 1)^2 goes: a point of the plane z = 0 (disc, gaussian), a direction (sphere, hemisphere,
  /// cosine_hemisphere, cone), a point of the triangle (0, 0), (1, 0), (1/2, sqrt(3)/2), or a point of the
  /// rectangle [-1.2, 0.8] x [-0.6, 1] at z = 0.5 that the origin sees.
  vec3 map(vec2 u) const;
  /// What the warp's own pdf says of the point, per unit area of the plane, the triangle or the rectangle, or
  /// per sr.
  double pdf(vec3 point) const;
  /// Is it a direction's density?
  bool on_sphere() const;

  /// A chart: the square's coordinates of a point of the domain; outside of [0, 1]^2 where the point is
  /// outside of the domain. Azimuth and radius or z, or along two edges.
  vec2 chart(vec3 point) const;
  vec3 from_chart(vec2 q) const;
  /// Area or solid angle of the domain per unit area of the chart.
  double chart_measure(vec2 q) const;

private:
  WarpOptions options_;
  float one_minus_cos_max_; ///< of the sphere's cap about +z that is the domain
  SphericalRectangle rectangle_;
};

/// Draws points through a warp and counts them. A value; draws as the source's independent, replayable
/// samples of Dimension::film.
class WarpLesson {
public:
  WarpLesson(const WarpOptions& options, SampleSource source, std::uint64_t samples);

  const WarpOptions& options() const { return options_; }
  const WarpMap& warp() const { return warp_; }
  const SampleSource& source() const { return source_; }
  std::uint64_t samples() const { return samples_; }
  std::uint64_t done() const { return done_; }
  bool finished() const { return done_ >= samples_; }
  void advance(std::uint64_t count);
  /// Where one sample goes, made again.
  vec3 replay(std::uint64_t sample) const;
  /// Cells of the chart; column 0 begins at chart x = 0.
  const Histogram& histogram() const { return histogram_; }

private:
  WarpOptions options_;
  WarpMap warp_;
  SampleSource source_;
  std::uint64_t samples_, done_ = 0;
  Histogram histogram_;
};

} // namespace candela
