#pragma once
// The lesson `brdf`: the lobe of a scattering model, its albedo by Monte Carlo, and a test of its samples
// against its pdf.

#include "core/fields.h"
#include "lab/histogram.h"
#include "lab/source.h"
#include "materials/direction_sampling.h"

namespace candela {

struct BrdfOptions {
  float theta = radians(40.0f); ///< of wo, from the normal; wo is in the plane of x and z, with x >= 0
  DirectionSampling sampling = DirectionSampling::bsdf;
  bool operator==(const BrdfOptions&) const = default;

  vec3 wo() const { return {std::sin(theta), 0, std::cos(theta)}; }
};
std::span<const Field<BrdfOptions>> brdf_fields();

/// The histogram's chart of the sphere of directions: azimuth from +x, and angle from +z.
vec2 direction_chart(vec3 w);
vec3 direction_from_chart(vec2 q);

/// Scattering of a delta lobe into its direction.
struct DeltaLobe {
  vec3 wi;
  std::uint64_t count = 0;
  vec3 weight_sum{0};
};

/// Samples the model's directions like the second vertex of a path, with the dimensions bsdf_direction and
/// bsdf_lobe. A value.
class BrdfLesson {
public:
  static constexpr ChartGrid kGrid{48, 48}; ///< 24 rows above the surface, 24 below

  BrdfLesson(Bsdf bsdf, const BrdfOptions& options, SampleSource source, std::uint64_t samples);

  const Bsdf& bsdf() const { return bsdf_; }
  const BrdfOptions& options() const { return options_; }
  const SampleSource& source() const { return source_; }
  std::uint64_t samples() const { return samples_; }
  std::uint64_t done() const { return done_; }
  bool finished() const { return done_ >= samples_; }
  void advance(std::uint64_t count);

  /// Directional-hemispherical reflectance plus transmittance: the mean of the samples' weights f |cos| /
  /// pdf, and its standard error as if they were independent.
  vec3 albedo() const;
  vec3 albedo_error() const;

  /// Directions of lobes without delta by direction_chart(); samples that failed (below the surface,
  /// absorbed) or took a delta lobe are outside.
  const Histogram& histogram() const { return histogram_; }
  std::uint64_t failed() const { return failed_; } ///< samples that carried no light
  std::span<const DeltaLobe> delta_lobes() const { return delta_lobes_; }

private:
  Bsdf bsdf_;
  BrdfOptions options_;
  SampleSource source_;
  std::uint64_t samples_, done_ = 0, failed_ = 0;
  std::array<RunningStatistics, 3> weights_; ///< by channel
  Histogram histogram_;
  std::vector<DeltaLobe> delta_lobes_;
};

} // namespace candela
