#pragma once
// One pass over the film: the unit of work of the session and of the command line.

#include "core/stop_condition.h"
#include "render/camera/camera_model.h"
#include "render/film/film.h"
#include "render/world/render_scene.h"

#include <array>

namespace candela {

/// Which samples of which pixels. The first pass of an interactive render visits the pixels of a coarse
/// lattice first, then those of finer ones: every level adds its own pixels' sample 0, so nothing is traced
/// twice or thrown away.
struct SampleRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 1;
  int lattice = 1;      ///< pixels whose x and y are multiples of it ...
  int skip_lattice = 0; ///< ... but not both of this one; 0: skip none
};

struct CropWindow { ///< pixels of the frame; empty width or height: the whole film
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const CropWindow&) const = default;
};

struct PassOptions {
  int threads = 0; ///< 0: every core
  CropWindow crop;
  /// Films of the film's size and origin for the emitted, the direct and the indirect part of the same
  /// samples; null: none.
  std::array<Film*, 3> components{};
  /// In place of the document's camera; null: that one.
  std::shared_ptr<const CameraModel> camera = nullptr;
};

struct PassResult {
  bool completed = false;
  bool converged = false; ///< adaptive sampling has nothing left to do in the window
  RayCounts rays;
  NonFiniteLog nonfinite;
};

/// Adds those of the range's samples to the film that its pixels do not have: a pixel gets its samples in
/// their order, so the first of them that it lacks is the number that it has. The samples do not depend on
/// threads, tiles or earlier passes. Polls `stop` every few rays and ends early where it is asked to; the
/// film then holds whole samples, of some pixels more than of others, and the same pass again brings the
/// rest. Samples that are not finite are logged, not added. With adaptive.error set, blocks of pixels whose
/// error is small enough get no more samples.
PassResult render_pass(const RenderScene& scene, const Document& document, const SampleRange& range,
                       Film& film, const StopCondition& stop, const PassOptions& options = {});

/// One sample again, alone, bit for bit as the pass traced it.
vec3 replay_sample(const RenderScene& scene, const Document& document, uvec2 pixel, std::uint32_t sample);

/// Factor that makes the view displayable: the depth view is shown relative to the scene's diagonal.
float display_scale(const RenderScene& scene, const RenderSettings& settings);

} // namespace candela
