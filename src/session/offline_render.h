#pragma once
// A render to completion, as by the command line: the same accumulation as in the window, in larger passes.

#include "render/film/render_pass.h"

#include <atomic>
#include <functional>
#include <memory>

namespace candela {

struct OfflineProgress {
  int spp = 0; ///< complete passes
  double render_seconds = 0;
  double fraction = 0; ///< towards the nearest stopping criterion, 0..1
  RayCounts rays;
};

struct OfflineOptions {
  PassOptions pass;
  bool components = false; ///< also store the emitted, direct and indirect components separately
  /// A scene of before, whose geometry and lights are reused where the document has the same; may be null.
  std::shared_ptr<const RenderScene> previous = nullptr;
  /// Ends the render early: throws Cancelled while the scene is built; later the film keeps its samples.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const OfflineProgress&)> progress; ///< called after each pass
};

struct OfflineResult {
  std::shared_ptr<const RenderScene> scene; ///< the rendered scene
  Film film;                                ///< of the crop window only, if there is one; mixed
  LayerFilm layers;                         ///< beside it, of scene->light_layers()
  std::array<Film, 3> components;           ///< emitted, direct, indirect, if requested
  int spp = 0;                              ///< complete passes
  double build_seconds = 0;
  double render_seconds = 0;
  RayCounts rays;
  NonFiniteLog nonfinite;
  float display_scale = 1;
  double noise = 0;       ///< square root of the film's estimated_relmse; infinite below two samples
  bool converged = false; ///< adaptive sampling stopped everywhere
  std::size_t scene_bytes = 0;
  bool interrupted = false; ///< by `stop`
  /// Share of the pixels without samples, if the render ended within the first pass. The film holds the value
  /// of a pixel of a coarser grid instead, if that has been rendered.
  double missing = 0;
};

/// Renders until the document's stop.spp, stop.time or stop.noise, whichever comes first, or until adaptive
/// sampling has stopped everywhere. The time limit also applies within passes, so some pixels may get one
/// more sample than others. The first pass goes from a coarse grid of pixels to finer ones, so that there is
/// a complete picture early. Throws a usage error if the document has no criterion.
OfflineResult render_document(const Document& document, const OfflineOptions& options = {});

struct ViewPicture {
  Image image;
  float display_scale = 1;
};

/// Another view of a rendered document, with the same number of samples: from the film if it holds the view,
/// otherwise by additional passes.
ViewPicture render_view(const Document& document, const OfflineResult& rendered, View view,
                        const OfflineOptions& options = {});

} // namespace candela
