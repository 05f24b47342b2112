#pragma once
// The interface for rendering a pass, the unit of work of every render. The CPU implements it
// (cpu_pass_renderer.h); a GPU or other machines could, too.

#include "core/stop_condition.h"
#include "render/camera/camera_model.h"
#include "render/film/layer_film.h"
#include "render/film/nonfinite_log.h"
#include "render/film/sample_range.h"
#include "render/integrators/ray_counts.h"
#include "scene/document.h"

#include <array>
#include <memory>

namespace candela {

class RenderScene;

/// Samples to render: `scene` was built from `document`.
struct PassJob {
  const RenderScene& scene;
  const Document& document;
  SampleRange range;
  CropWindow window{}; ///< pixels of the frame; empty: the whole film
  /// In place of the document's camera; null: that one.
  std::shared_ptr<const CameraModel> camera = nullptr;
};

/// Where the samples go.
struct PassFilms {
  Film& image;
  /// Films of the image's size and origin for the emitted, the direct and the indirect part of the same
  /// samples; null: none.
  std::array<Film*, 3> components{};
  /// Of the image's size, with the scene's light layers; null: none. Then `image` holds their sum, at factor
  /// 1, and the components the mix with the document's factors.
  LayerFilm* layers = nullptr;
};

struct PassResult {
  bool completed = false;
  bool converged = false; ///< adaptive sampling has nothing left to do in the window
  RayCounts rays;
  NonFiniteLog nonfinite;
};

class PassRenderer {
public:
  virtual ~PassRenderer() = default;

  /// Adds those of the job's samples to the films that its pixels do not have: a pixel gets its samples in
  /// their order, so the first of them that it lacks is Film::tried. The samples depend on the scene, the
  /// document, pixel and sample index alone: on no earlier pass, tile or number of workers. Polls `stop`
  /// often and ends early where it is asked to; the films then hold whole samples, of some pixels more than
  /// of others, and the same job again brings the rest. Samples that are not finite are logged, not added.
  /// With adaptive.error set, blocks of pixels whose error is small enough get no more samples.
  virtual PassResult render(const PassJob& job, const PassFilms& films, const StopCondition& stop) = 0;

protected:
  PassRenderer() = default;
  PassRenderer(const PassRenderer&) = default;
  PassRenderer& operator=(const PassRenderer&) = default;
};

} // namespace candela
