#pragma once
// The lesson `warps`: the maps of the unit square in sampling/warp.h, and a test of their samples against
// their pdf.

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
/// Whether the warp has the option of this key.
bool warp_uses(Warp warp, std::string_view key);

/// One warp with its density and a chart of its domain.
class WarpMap {
public:
  explicit WarpMap(const WarpOptions& options);

  /// The image of u in [0, 1)^2: a point of the plane z = 0 (disc, gaussian), a direction (sphere,
  /// hemisphere, cosine_hemisphere, cone), a point of the triangle (0, 0), (1, 0), (1/2, sqrt(3)/2), or a
  /// point of the rectangle [-1.2, 0.8] x [-0.6, 1] at z = 0.5 that the origin sees.
  vec3 map(vec2 u) const;
  /// The warp's pdf at the point, per unit area of the plane, the triangle or the rectangle, or per sr.
  double pdf(vec3 point) const;
  /// Whether the pdf is a density of directions.
  bool on_sphere() const;

  /// The chart coordinates of a point: azimuth and radius or z, or along two edges. They are outside [0, 1]^2
  /// if the point is outside the domain.
  vec2 chart(vec3 point) const;
  vec3 from_chart(vec2 q) const;
  /// Area or solid angle of the domain per unit area of the chart.
  double chart_measure(vec2 q) const;

private:
  WarpOptions options_;
  float one_minus_cos_max_; ///< of the domain, a cap of the sphere about +z
  SphericalRectangle rectangle_;
};

/// Counts points drawn with a warp. A value; the draws are samples of Dimension::film, which can be repeated.
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
  /// Repeats the draw of one sample.
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
