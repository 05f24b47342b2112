#pragma once
// How paths leave their vertices: scattered directions of many, Russian roulette and the rays from there,
// side by side.

#include "render/integrators/vertex_lanes.h"

namespace candela {

/// With what probability a path goes on (Arvo and Kirk 1990): going on with probability q and weight 1/q
/// keeps the mean.
struct Roulette {
  float least = 1;             ///< q at least
  float threshold = kInfinity; ///< the throughput that is worth 1
  float most = 1;              ///< q at most, before `least` is asked: see survival_bound()

  /// For paths of `depth` segments.
  static Roulette at(const PathSettings& settings, int depth);
};

/// The highest chance with which a path of `depth` segments may go on, whatever it carries and whatever the
/// settings say: in rooms and glass that lose no light the throughput stays 1, and nothing else ends a path.
float survival_bound(int depth);

/// A direction from each lane of VertexLanes, at most.
struct OnwardLanes {
  // What is asked:
  Vec3Lanes wi_local;    ///< unit, about the normal
  Vec3Lanes throughput;  ///< of the path with this direction, before roulette; after it when chosen
  Lanes<float> unscaled; ///< what roulette multiplies it by, see PathTracer::Path
  Lanes<float> u;        ///< roulette's number
  Lanes<float> folds;    ///< 1 or 0: what is on the wrong side of the surface is folded back
  // What comes of it:
  Vec3Lanes origin, direction;
  Lanes<std::int32_t> goes_on; ///< 1 or 0: ended by roulette, or through the surface

  /// In all lanes; what comes of those where nothing was asked means nothing.
  void choose(const VertexLanes& vertices, const Roulette& roulette);
};

} // namespace candela
