#pragma once
// The path tracer: radiance along camera rays by random walks from the eye.

#include "core/stop_condition.h"
#include "render/integrators/direct_light.h"
#include "render/integrators/onward.h"
#include "render/integrators/path_sample.h"
#include "render/integrators/transport.h"

#include <span>
#include <vector>

namespace candela {

/// Whether the settings show light of paths of `depth` segments.
bool shows_depth(const PathSettings& settings, int depth);
/// Where Russian roulette is off and path.max_depth sets no limit, paths end after so many segments.
inline constexpr int kMostSegmentsWithoutRoulette = 1024;
/// The longest path that can matter under the settings, in segments.
int longest_path(const PathSettings& settings);

/// Where a path begins, at a pixel's sample.
struct PathStart {
  Ray ray;
  Sampler sampler;
  Interiors interiors{}; ///< of the ray's origin, in scenes with absorption
};

/// Traces paths many at a time, one segment of all of them after the other: all meet their surfaces, all aim
/// at lights, all choose their next directions. A stage is a loop over paths that know nothing of each other,
/// so the vector unit makes random numbers and light samples of several at once, and the processor works on
/// the next one while it waits for this one. On the Cornell box that was 1.4 times as fast as one path after
/// another; with surfaces, light samples, roulette and rays made side by side, too, in lanes (core/lanes.h),
/// it is 1.25 times as fast as that. What a path brings back does not depend on the company that it travels
/// in.
///
/// A pixel's first sample is never split, so that the first picture does not wait for it.
///
/// Unbiased unless the settings say otherwise (max_depth, component, only_depth). For one thread; keep it,
/// for it keeps its memory.
class PathTracer {
public:
  PathTracer(const RenderScene& scene, const PathSettings& settings);

  /// One sample of the radiance that arrives along each start's ray. `results` has as many. False, and
  /// results of no use, where it was asked to stop, which it polls every few rays.
  bool trace(std::span<const PathStart> starts, std::span<PathSample> results, RayCounts& counts,
             StopPoll& stop);

private:
  /// A walk on its way: what the next vertex needs to know of those before.
  struct Path {
    explicit Path(const PathStart& start) : ray(start.ray), sampler(start.sampler) {}
    explicit Path(const Sampler& s) : sampler(s) {}

    Ray ray;
    Sampler sampler;
    vec3 throughput{1}; ///< product of f |cos| / pdf and of 1 / survival so far
    /// What Russian roulette multiplies the throughput by: it leaves out the 1/eta^2 of refractions, which
    /// the way out of the glass gives back, and the share of a split.
    float roulette_scale = 1;
    std::uint32_t result = 0; ///< the sample that it adds to
    bool split = false;       ///< has, or may not any more
    // The last vertex: how the path left it.
    bool arrived_by_delta = true; ///< the camera cannot be aimed from
    float arrival_density = 0;    ///< 1/sr, times the number of directions tried there
    LightReference reference;
  };

  /// A path at a surface that scatters, in vertices_.
  struct Stop {
    Path* path;
    std::uint32_t lane;
    int branches; ///< directions to try
  };

  void intersect(int depth, StopPoll& stop);
  void meet_emitters(int depth);
  void stop_at(std::size_t begin, std::size_t count, int depth, StopPoll& stop);
  void prepare_aiming(std::size_t lane);
  bool leave(std::uint32_t branch, int depth);
  bool meet_in_bodies(std::size_t path, bool known, bool met, Hit& hit);
  Interiors& interiors_of(const Path& path) {
    return interiors_[static_cast<std::size_t>(&path - paths_.data())];
  }

  void meet_background(int depth);
  void add_background(const Path& path, std::uint32_t light, vec3 radiance, float pdf, int depth);
  void add_emission(const Path& path, const Surface& surface, vec3 emission, int depth);
  bool needs_aimed_pdf(const Path& path) const;
  float weight_by_chance(const Path& path, float aimed) const;

  const RenderScene& scene_;
  PathSettings settings_;
  int last_depth_;

  // Of the batch in flight.
  std::span<PathSample> results_;
  RayCounts counts_;
  std::vector<Path> paths_, next_;
  /// Of their rays, parallel to them; in scenes with absorption alone.
  std::vector<Interiors> interiors_, next_interiors_;
  std::vector<const Ray*> rays_; ///< of the paths, where they are traced together
  std::vector<Path*> missed_;
  std::vector<EnvironmentMap::Place> places_; ///< parallel to missed_
  std::vector<Path*> arrived_;
  std::vector<Hit> hits_; ///< parallel to arrived_

  // Of the lanes in flight.
  VertexLanes vertices_;
  std::vector<Stop> stops_;
  bool several_lobes_ = false; ///< a BSDF at the stops asks for BsdfU::lobe
  LightSeekers seekers_;
  DirectLight direct_light_;
  OnwardLanes onward_{};          ///< all of it is computed with, used or not
  std::vector<Sampler> branched_; ///< of paths that split
};

} // namespace candela
