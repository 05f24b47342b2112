#pragma once
// The accumulated samples of a picture, advanced by the window, the command line and the benchmarks. A value:
// it can be copied, saved as its state, continued by another renderer, and merged with samples that were
// rendered elsewhere.

#include "render/film/pass_renderer.h"
#include "render/film/sample_schedule.h"
#include "scene/light_layers.h"

#include <functional>
#include <limits>

namespace candela {

struct AccumulationOptions {
  CropWindow window{}; ///< of the frame; empty: all of it
  /// The first pass visits pixels at this distance (a power of two), then those between them, for an early
  /// complete picture. 1: all at once.
  int coarsest = 1;
  bool components = false; ///< also store the emitted, direct and indirect components separately
  /// Factors of the scene's light layers, which are then kept apart; empty: there are none.
  LightMix mix{};
  /// Sample indices begin here, where another accumulation holds those before.
  std::uint32_t first_sample = 0;
  /// The time limit does not end the first pass.
  bool whole_first_pass = false;
};

/// How large a pass is.
struct Portion {
  /// That it should take, as far as can be told from those before; never more than 64 samples a pixel. Long
  /// passes cost less synchronisation, short ones are shown and end sooner.
  double seconds = 0.02;
  int most_samples = 0; ///< a pixel; 0: no limit
};

class Accumulation {
public:
  /// All that it is, as plain values: what a checkpoint stores and a rank sends.
  struct State {
    AccumulationOptions options;
    /// The sum of the light layers, whatever their factors. Pixels that the first pass has not visited yet
    /// mean nothing.
    Film film;
    LayerFilm layers;               ///< where options.mix has any
    std::array<Film, 3> components; ///< emitted, direct, indirect, where asked for
    /// Of the first pass: distance of the pixels that have their sample, 0: none; of those that are next, 0:
    /// it is complete.
    int visited_lattice = 0, next_lattice = 1;
    SampleSchedule schedule; ///< after the first pass
    bool open = false;       ///< the last pass ended early: the next one completes it
    bool converged = false;  ///< adaptive sampling has stopped everywhere in the region
    /// Square root of estimated_relmse() when stop.noise was tested last.
    double noise = std::numeric_limits<double>::infinity();
    RayCounts rays;
    NonFiniteLog nonfinite;
    double seconds = 0;            ///< of rendering, waiting excluded
    double first_pass_seconds = 0; ///< of them, those that gave every pixel its first sample
  };

  /// The next pass, as it was planned.
  struct Pass {
    SampleRange range;
    CropWindow window;
    bool first = false; ///< of the first samples of the pixels
  };
  struct Step { ///< what was done
    bool completed = false;
    RayCounts rays;
    double seconds = 0; ///< in the pass renderer
  };
  /// When and how to advance().
  struct Limits {
    StopCondition stop; ///< ends it in the middle of a pass
    Portion portion;
    std::function<void(const Accumulation&)> on_pass; ///< called after each complete pass; may be empty
  };

  /// Of no pixel.
  Accumulation() = default;
  Accumulation(const FilmSettings& frame, const AccumulationOptions& options) { restart(frame, options); }
  /// Continues a saved one.
  explicit Accumulation(State state) : state_(std::move(state)) {}

  /// Forgets all samples; the film's memory is kept and cleared when its pixels are visited. The region of
  /// set_region() stays.
  void restart(const FilmSettings& frame, const AccumulationOptions& options);

  /// Renders until finished(document.settings.stop), or until it is told to stop; false there.
  bool advance(PassRenderer& renderer, const RenderScene& scene, const Document& document,
               const Limits& limits);

  /// The pass that comes next, for a caller that decides between passes; `until` must not be reached.
  /// stop.spp and stop.noise bound its samples.
  Pass next(const StopSettings& until, const Portion& portion) const;
  /// Renders it; ends early at `stop` or at document.settings.stop.time.
  Step step(const Pass& pass, PassRenderer& renderer, const RenderScene& scene, const Document& document,
            StopCondition stop);

  /// The first of the stopping rules is met: spp, time, noise, or adaptive sampling has converged. A pass
  /// that was left open is completed before an accumulation is finished by spp.
  bool finished(const StopSettings& until) const;
  /// Share of the way to the nearest of stop.spp and stop.time, 0..1; 0 where there is neither.
  double fraction(const StopSettings& until) const;

  /// Other factors of the same light layers: of the samples that there are, and of those that come. Where
  /// the noise of the mix is not known, it is found at the next sample number at which stop.noise is tested.
  void set_mix(const LightMix& mix, const StopSettings& until);
  const LightMix& mix() const { return state_.options.mix; }

  /// Only these pixels get samples after the first pass; empty: all. Those that fell behind catch up.
  void set_region(const CropWindow& region);

  /// Adds samples that were rendered elsewhere: those of a window within this one's that follow the samples
  /// that its pixels have here. Sums, counts, logs and seconds add up. False, and nothing changes, where they
  /// do not follow, where either holds a part of a pass, where only one keeps components, or where adaptive
  /// sampling has stopped pixels that the other continues (it must see all samples of a pixel).
  bool merge(const Accumulation& later);

  /// Complete passes over the region since first_sample; 0 until the first pass is complete.
  int spp() const;
  /// Samples a pixel that were begun: spp(), or the share of the levels of the first pass.
  double samples_per_pixel() const;
  /// Side of the blocks that one sample stands for; 1 from the first pass on, 0 before any.
  int coarseness() const { return spp() > 0 ? 1 : state_.visited_lattice; }
  bool at_coarsest() const { return state_.visited_lattice == 0 && state_.next_lattice != 0; }

  /// At factor 1 of all light layers.
  const Film& film() const { return state_.film; }
  /// That of the mix: film(), or made in `memory`; while the first pass is coarse, of the pixels that it has
  /// visited.
  const Film& picture(Film& memory) const;
  const RayCounts& rays() const { return state_.rays; }
  const NonFiniteLog& nonfinite() const { return state_.nonfinite; }
  double seconds() const { return state_.seconds; }
  double first_pass_seconds() const { return spp() > 0 ? state_.first_pass_seconds : 0; }
  bool converged() const { return state_.converged; }
  /// The last pass ended early.
  bool open() const { return state_.open; }

  const State& state() const& { return state_; }
  State&& state() && { return std::move(state_); }

private:
  CropWindow window() const;
  void clear(const SampleRange& range);
  void estimate_noise();
  void complete(const Pass& pass, const PassResult& result, const RenderSettings& settings);

  State state_;
  /// The film's pixels are 0, though not yet cleared.
  bool blank_ = false;
  double seconds_per_sample_ = 0; ///< of one pixel, in the newest whole pass; 0: none was timed
};

} // namespace candela
