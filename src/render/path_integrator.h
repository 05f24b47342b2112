#pragma once
// The path tracer: radiance along camera rays by random walks from the eye.

#include "render/direct_light.h"
#include "render/onward.h"
#include "render/path_sample.h"
#include "render/transport.h"

#include <span>
#include <vector>

namespace candela {

/// Whether the settings show light of paths of `depth` segments.
bool shows_depth(const PathSettings& settings, int depth);
/// The longest path that can matter under the settings, in segments.
int longest_path(const PathSettings& settings);

/// Where a path begins: in empty space, at a pixel's sample.
struct PathStart {
  Ray ray;
  Sampler sampler;
};

/// Traces paths many at a time, one segment of all of them after the other: all meet their surfaces, all aim
/// at lights, all choose their next directions. A stage is a loop over paths that know nothing of each other,
/// so the vector unit makes random numbers and light samples of several at once, and the processor works on
/// the next one while it waits for this one. On the Cornell box that is 1.4 times as fast as one path after
/// another. What a path brings back does not depend on the company that it travels in.
///
/// A pixel's first sample is never split, so that the first picture does not wait for it.
///
/// Unbiased unless the settings say otherwise (max_depth, component, only_depth). For one thread; keep it,
/// for it keeps its memory.
class PathTracer {
public:
  PathTracer(const RenderScene& scene, const PathSettings& settings);

  /// One sample of the radiance that arrives along each start's ray. `results` has as many.
  void trace(std::span<const PathStart> starts, std::span<PathSample> results, RayCounts& counts);

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

  /// A path at a surface that scatters.
  struct Stop {
    Stop(Path& p, const RenderScene& scene, const Hit& hit) : path(&p), vertex(scene, p.ray, hit) {}

    Path* path;
    Vertex vertex;
    Bsdf textured;         ///< where the material has a texture
    bool specular = false; ///< there is nothing that could be aimed from
    int branches = 1;      ///< directions to try

    const Bsdf& bsdf() const {
      return vertex.material->diffuse_texture != nullptr ? textured : vertex.material->bsdf;
    }
  };

  void meet_surfaces(int depth);
  void aim(int depth);
  void choose_directions(int depth);

  void prepare_aiming(Stop& stop) const;
  void meet_background(int depth);
  void add_background(const Path& path, std::uint32_t light, vec3 radiance, float pdf, int depth);
  void add_emission(const Path& path, const Vertex& vertex, int depth);
  bool needs_aimed_pdf(const Path& path) const;
  float weight_by_chance(const Path& path, float aimed_pdf) const;
  void leave(std::size_t begin, std::size_t count, const Roulette& roulette);

  const RenderScene& scene_;
  PathSettings settings_;
  int last_depth_;

  // Of the batch in flight.
  std::span<PathSample> results_;
  RayCounts counts_;
  std::vector<Path> paths_, next_;
  std::vector<Path*> missed_;
  std::vector<EnvironmentMap::Place> places_; ///< parallel to missed_
  std::vector<Path*> arrived_;
  std::vector<Hit> hits_; ///< parallel to arrived_
  std::vector<Stop> stops_;
  std::vector<LightSeeker> seekers_;
  std::vector<const Stop*> tries_;   ///< directions to try, by where from
  std::vector<Sampler> branched_;    ///< of tries that split a path
  std::vector<Sampler::Draw> draws_; ///< parallel to tries_, as are these
  std::vector<vec2> disc_;           ///< BsdfU::disc
  std::vector<float> lobe_u_, roulette_u_;
  OnwardLanes onward_;
  /// Of a direction in onward_.
  struct Leaving {
    std::size_t attempt; ///< index into tries_
    float density;       ///< Path::arrival_density
    bool delta;
  };
  Lanes<Leaving> leaving_;
};

} // namespace candela
