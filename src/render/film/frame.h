#pragma once
// A snapshot of a render: immutable, for any thread to read.

#include "render/film/nonfinite_log.h"
#include "render/integrators/ray_counts.h"
#include "scene/light_layers.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace candela {

struct Frame {
  std::uint64_t generation = 0; ///< of the Document that it shows, as RenderSession::submit returned it
  int width = 0;
  int height = 0;
  int coarseness = 1; ///< side of the blocks of one sample while the first pass refines: 8, 4, 2, then 1
  int spp = 0;        ///< complete passes
  /// As it was when the accumulation began, with the light groups as they are.
  std::shared_ptr<const Document> document;
  LightMix mix; ///< of the light layers that it shows; empty: there are none
  View view = View::radiance;
  std::vector<vec3> linear; ///< the view; row 0 is the top; holes of a coarse pass filled from their block
  /// Per pixel, of the accumulated mean; empty while the first pass is coarse.
  std::vector<vec3> variance;
  std::vector<std::uint32_t> samples; ///< per pixel; empty while coarse
  float display_scale = 1;            ///< multiplies `linear` for display (film_view.h)
  RayCounts rays;                     ///< of this accumulation
  double render_seconds = 0;          ///< of this accumulation, waiting excluded
  double first_pass_seconds = 0; ///< of them, those that gave every pixel its first sample; 0 while coarse
  NonFiniteLog nonfinite;
};

} // namespace candela
