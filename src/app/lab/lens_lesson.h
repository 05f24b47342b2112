#pragma once
// The lesson `lens`: what a lens of many elements does that a thin lens does not. It vignettes, and its spots
// have aberrations.

#include "app/figures/plot.h"
#include "core/fields.h"
#include "core/statistics.h"
#include "lab/source.h"
#include "render/camera/lens_system.h"

namespace candela {

struct LensOptions {
  int lens = 0;           ///< index into kLenses
  float f_stop = 0;       ///< 0: wide open
  float focus = 3;        ///< metres from the entrance pupil
  float film_height = 10; ///< of the film point from the axis, millimetres
  bool operator==(const LensOptions&) const = default;
};
std::span<const Field<LensOptions>> lens_fields();

/// Estimates how much light a film point gets, with the dimension lens as cameras use it. A value.
class LensLesson {
public:
  LensLesson(const LensOptions& options, SampleSource source, std::uint64_t samples);

  const LensOptions& options() const { return options_; }
  const SampleSource& source() const { return source_; }
  const LensSystem& lens() const { return *lens_; }
  std::uint64_t samples() const { return samples_; }
  std::uint64_t done() const { return done_; }
  bool finished() const { return done_ >= samples_; }
  void advance(std::uint64_t count);

  /// Of the film point: its irradiance over that of the film's middle at infinity, under a uniform scene, and
  /// its standard error as if the samples were independent.
  double illumination() const { return weights_.mean(); }
  double illumination_error() const { return std::sqrt(weights_.variance_of_mean()); }
  /// Share of the samples that passed: how well the exit pupil's ellipse fits.
  double passing() const;

  /// Diameter of the spot of a point on the axis over its distance, and a thin lens's.
  const Plot& blur_plot() const { return plots_->blur; }
  /// Illumination over the film's radius, and cos^4 of the angle.
  const Plot& vignetting_plot() const { return plots_->vignetting; }

private:
  struct Plots {
    Plot blur, vignetting;
  };

  LensOptions options_;
  SampleSource source_;
  std::uint64_t samples_, done_ = 0, passed_ = 0;
  std::shared_ptr<const LensSystem> lens_;
  RunningStatistics weights_;
  std::shared_ptr<const Plots> plots_; ///< of the lens: made once, on whichever thread makes the lesson
};

} // namespace candela
