#pragma once
// The path tracer: radiance along camera rays by random walks from the camera.

#include "core/stop_condition.h"
#include "render/integrators/continuation.h"
#include "render/integrators/direct_light.h"
#include "render/integrators/path_length.h"
#include "render/integrators/path_sample.h"
#include "render/integrators/subsurface_probe.h"
#include "render/integrators/transport.h"

#include <span>
#include <vector>

namespace candela {

/// Where a path begins, at a pixel's sample.
struct PathStart {
  Ray ray;
  Sampler sampler;
  MediumStack media{}; ///< of the ray's origin, in scenes with media
  RayCone cone{};      ///< of the pixel, in scenes that filter textures
};

/// Traces paths many at a time, one segment of all of them after the other (Laine et al. 2013, "Megakernels
/// Considered Harmful"). For each segment, the stages are:
/// - intersect: the closest hits;
/// - sample_media: through transparent surfaces and media, to a surface or out of the scene;
/// - add_environment, for paths that escaped, and add_emission, for those that hit a surface;
/// - at the surface vertices: sample_lights, then sample_bsdfs, Russian roulette and continuation rays;
/// - leave_subsurface: the same where light that entered a surface there leaves it, by a diffusion profile.
/// A stage is a loop over paths that know nothing of each other, so the vector unit makes random numbers and
/// light samples of several at once, and the processor works on the next one while it waits for this one. On
/// the Cornell box that was 1.4 times as fast as one path after another; with surfaces, light samples,
/// roulette and rays made side by side, too, in lanes (core/lanes.h), it is 1.25 times as fast as that. What
/// a path brings back is independent of the batch that it is traced in.
///
/// A pixel's first sample is never split, so that the first picture does not wait for it.
///
/// Unbiased unless the settings say otherwise (max_depth, component, only_depth). For one thread; keep it,
/// for it keeps its memory.
class PathTracer {
public:
  PathTracer(const RenderScene& scene, const PathSettings& settings);

  /// One sample of the radiance that arrives along each start's ray. `results` has as many. `layers`, if not
  /// empty, has RenderScene::layer_count() for each of them, the same radiance by layer. False, and results
  /// of no use, where it was asked to stop, which it polls every few rays.
  bool trace(std::span<const PathStart> starts, std::span<PathSample> results, RayCounts& counts,
             StopPoll& stop, std::span<PathSample> layers = {});

private:
  /// What the next vertex needs to know of those before.
  struct Path {
    explicit Path(const PathStart& start) : ray(start.ray), sampler(start.sampler) {}
    explicit Path(const Sampler& s) : sampler(s) {}

    Ray ray;
    Sampler sampler;
    Spectrum throughput{1}; ///< product of f |cos| / pdf, transmittances and 1 / survival so far
    /// What Russian roulette multiplies the throughput by: it leaves out the 1/eta^2 of refractions, which
    /// the way out of the glass gives back, and the share of a split.
    float eta_scale = 1;
    std::uint32_t result = 0; ///< the sample that it adds to
    bool split = false;       ///< has, or may not any more
    // The last vertex: how the path left it.
    bool specular_bounce = true; ///< by a delta lobe; light sampling does not find camera rays either
    float bsdf_pdf = 0;          ///< 1/sr, times the number of directions sampled there
    LightSamplingContext light_context;
  };

  /// A path at a surface that scatters, in vertices_.
  struct ScatteringVertex {
    Path* path;
    std::uint32_t lane;
    int branches; ///< directions to sample
    /// Density of light sampling there over that of BSDF sampling is scaled by its inverse: see MediumVertex.
    float pdf_scale = 1;
  };
  /// How a ray's way through media ends.
  enum class RayEnd { escaped, surface, collision };
  /// A point in a medium that scatters.
  struct MediumVertex {
    Path* path;
    vec3 position;
    const PhaseFunction* phase;
    /// p / q, with the density p of such a distance for collisions and q for light sampling; both strategies
    /// find light by the distance and the direction, so the density of the direction is scaled by this for
    /// MIS. Infinite where lights are not sampled.
    float pdf_ratio;
  };
  /// One that lights are sampled for.
  struct MediumLightVertex : MediumVertex {
    Spectrum throughput; ///< of the path to it, sigma_s and its density q included
    MediumStack bodies;
  };
  /// A direction that is sampled from a vertex: a continuation of its path.
  struct SampledDirection {
    const ScatteringVertex* vertex;
    const Sampler* sampler; ///< of the branch
    std::uint32_t lane;     ///< of the vertex
    float bsdf_pdf;         ///< as of Path
    bool delta;
  };

  /// A path that has entered a surface, in entries_.
  struct SubsurfaceEntry {
    Path path;
    SubsurfacePoint point;
    Subsurface bsdf;
  };

  // The stages, in their order.
  void intersect(int depth, StopPoll& stop);
  void sample_media(int depth, StopPoll& stop);
  void add_environment(int depth);
  void add_emission(int depth);
  void scatter(std::size_t begin, std::size_t count, int depth, StopPoll& stop);
  void make_vertices(std::size_t begin, std::size_t count, int depth);
  void sample_lights(std::size_t begin, int depth, StopPoll& stop);
  bool sample_bsdfs(std::uint32_t branch, int depth);
  void fold_directions();
  void continue_paths();

  /// Whether light may pass surfaces or fade between them.
  bool passes_media() const { return scene_.has_transparency() || scene_.has_media(); }
  bool pass_media(std::size_t path, bool met, Hit& hit);
  // Of scenes with active media, in path_media.cpp:
  RayEnd pass_active_media(std::size_t path, bool met, Hit& hit, int depth);
  RayEnd pass_grids(std::size_t path, const Ray& ray, RayEnd end, const MediumStack& behind, int depth);
  bool samples_apart() const;
  float collision_distance(const Path& path, int depth) const;
  float choose_light_vertex(Path& path, const Ray& ray, Spectrum channels, const MediumPoint* collision,
                            int depth);
  std::optional<EquiangularSampling> equiangular_about_light(const Path& path, const Ray& ray) const;
  void add_medium_emission(const Path& path, Spectrum emission, int depth);
  void sample_lights_in_media(int depth, StopPoll& stop);
  void scatter_in_media(int depth, StopPoll& stop);
  // Of scenes with diffusion profiles, in path_subsurface.cpp:
  void offer_entries(std::size_t begin);
  bool enters_subsurface(const SampledDirection& direction) const;
  void enter_subsurface(const SampledDirection& direction);
  void leave_subsurface(int depth, StopPoll& stop);
  void find_exits(int depth, StopPoll& stop);
  void make_exit_vertices(std::size_t begin, std::size_t count);
  void sample_lights_at_exits(std::size_t begin, int depth, StopPoll& stop);
  int branches_at(const Path& path, bool specular) const {
    return path.split || specular ? 1 : settings_.split;
  }
  void divide(Path& path, bool arrives) { (arrives ? arrived_ : escaped_).push_back(&path); }
  void set_lobe(std::size_t lane, const Bsdf& bsdf);
  /// Null in scenes that do not filter textures.
  const ConeOfRay* cone_of(const Path& path) const {
    return scene_.filters_textures() ? &cones_[static_cast<std::size_t>(&path - paths_.data())] : nullptr;
  }
  /// For emission and opacity. Light sampling meets these, too, and has no cone: both strategies must see the
  /// same.
  const ConeOfRay* cone_of_view(const Path& path) const {
    return path.specular_bounce ? cone_of(path) : nullptr;
  }
  void continue_cone(const SampledDirection& direction);
  MediumStack& media_of(const Path& path) { return media_[static_cast<std::size_t>(&path - paths_.data())]; }
  void add_escaped(const Path& path, std::uint32_t light, Spectrum radiance, float pdf, int depth);
  void add_emitted(const Path& path, const SurfaceInteraction& surface, Spectrum emission, int depth);
  /// What a path adds to its sample's layer.
  PathSample& layer(const Path& path, std::uint8_t index) {
    return layers_[path.result * scene_.layer_count() + index];
  }
  bool needs_light_pdf(const Path& path) const;
  float bsdf_sampling_weight(const Path& path, float light_pdf) const;

  const RenderScene& scene_;
  PathSettings settings_;
  int last_depth_;
  bool smooths_terminator_; ///< there is something to do for it

  // Of the batch in flight.
  std::span<PathSample> results_;
  std::span<PathSample> layers_; ///< of all results, one after the other; empty: not asked for
  RayCounts counts_;
  std::vector<Path> paths_, next_paths_;
  /// Of their rays, parallel to them; in scenes with media alone.
  std::vector<MediumStack> media_, next_media_;
  std::vector<ConeOfRay> cones_, next_cones_; ///< likewise, in scenes that filter textures alone
  std::vector<const Ray*> rays_;              ///< of the paths, where they are traced together
  std::vector<Hit> hits_;                     ///< of the paths; once these are divided, parallel to arrived_
  std::vector<Path*> escaped_;
  std::vector<EnvironmentMap::Place> places_; ///< parallel to escaped_
  std::vector<Path*> arrived_;                ///< at a surface
  MediumWay way_;                             ///< of the ray in flight
  std::vector<MediumLightVertex> light_vertices_;
  std::vector<MediumVertex> collisions_; ///< of paths that end in a medium

  std::vector<SubsurfaceEntry> entries_;
  std::vector<MediumStack> entry_media_; ///< parallel to entries_, as media_ to paths_
  std::vector<ConeOfRay> entry_cones_;
  std::vector<SubsurfaceExit> exits_; ///< of paths_, which leave a surface there
  SubsurfaceProbe probe_;
  std::size_t first_hit_ = 0; ///< that of the vertices' lane 0, where they are entries

  // Of the lanes in flight.
  VertexLanes vertices_;
  std::vector<ScatteringVertex> scattering_;
  BsdfFlags scattering_flags_ = BsdfFlags::none; ///< of all of them
  ShadingPoints shading_points_;
  std::vector<LayeredLight> layered_light_; ///< of shading_points_
  DirectLight direct_light_;
  Lanes<SampledDirection> directions_; ///< one of each vertex, at most
  std::size_t direction_count_ = 0;
  ContinuationLanes continuation_{}; ///< all of it is computed with, used or not
  std::vector<Sampler> branched_;    ///< of paths that split
};

} // namespace candela
