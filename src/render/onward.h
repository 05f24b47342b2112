#pragma once
// How paths leave their vertices: scattered directions of many, Russian roulette and the rays from there,
// side by side.

#include "core/lanes.h"
#include "render/transport.h"

namespace candela {

/// With what probability a path goes on (Arvo and Kirk 1990): going on with probability q and weight 1/q
/// keeps the mean.
struct Roulette {
  float least = 1;             ///< q at least
  float threshold = kInfinity; ///< the throughput that is worth 1

  /// For paths of `depth` segments.
  static Roulette at(const PathSettings& settings, int depth);
};

/// Up to kLaneCount of them. World space but for `local`.
struct OnwardLanes {
  std::size_t count = 0;
  // What is asked:
  Vec3Lanes normal, geometric_normal; ///< shading and geometric, of the vertex
  Vec3Lanes position, position_error;
  Lanes<float> side;     ///< Vertex::side
  Vec3Lanes local;       ///< where to, about the shading normal
  Lanes<float> cosines;  ///< of both directions with the shading normal, multiplied: > 0 where it reflects
  Vec3Lanes throughput;  ///< of the path with this direction, before roulette
  Lanes<float> unscaled; ///< what roulette multiplies it by, see PathTracer::Path
  Lanes<float> u;        ///< roulette's number
  // What comes of it; throughput, too:
  Vec3Lanes origin, direction;
  Lanes<std::int32_t> goes_on; ///< 1 or 0: ended by roulette, or through the surface

  void choose(const Roulette& roulette);
};

} // namespace candela
