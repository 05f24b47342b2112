#pragma once
// Continuation rays of many paths, side by side: Russian roulette, and the rays from the vertices.

#include "render/integrators/russian_roulette.h"
#include "render/integrators/vertex_lanes.h"

namespace candela {

/// At most one continuation of each lane of VertexLanes.
struct ContinuationLanes {
  // Input:
  Vec3Lanes wi_local;     ///< unit, about the normal
  Vec3Lanes throughput;   ///< of the path with this direction; output: after Russian roulette
  Lanes<float> eta_scale; ///< Russian roulette multiplies the throughput by it, see PathTracer::Path
  Lanes<float> u;         ///< Russian roulette's number
  Lanes<float> folds;     ///< 1 or 0: a direction on the wrong side of the surface is folded back
  // Output:
  Vec3Lanes origin, direction;
  Lanes<std::int32_t> survives; ///< 1 or 0: ended by roulette, or on the wrong side of the surface

  /// In all lanes; the output of those without input means nothing.
  void compute(const VertexLanes& vertices, const Roulette& roulette);
};

} // namespace candela
