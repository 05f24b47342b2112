#pragma once
// A render from start to finish, as the command line does it: the window's accumulation, in larger passes.

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
  bool components = false; ///< keep the emitted, direct and indirect parts apart, too
  /// Ends early: Cancelled is thrown while the scene is built, after that the film keeps what it has.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const OfflineProgress&)> progress; ///< called after each portion
};

struct OfflineResult {
  std::shared_ptr<const RenderScene> scene; ///< what was rendered
  Film film;                                ///< of the crop window alone, where there is one
  std::array<Film, 3> components;           ///< emitted, direct, indirect, where asked for
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
  /// Share of the pixels to be rendered that got no sample, for the render ended within the first pass: where
  /// a pixel of a coarser grid has been rendered, the film holds its value instead.
  double missing = 0;
};

/// Renders until the document's stop.spp, stop.time or stop.noise, whichever comes first, or until adaptive
/// sampling has stopped everywhere. The time is obeyed within passes, too, so the last one may bring some
/// pixels a sample more than others; the first pass goes from a coarse grid of pixels to finer ones, so that
/// there is a whole picture early. Throws a usage error where the document has none of them.
OfflineResult render_document(const Document& document, const OfflineOptions& options = {});

struct ViewPicture {
  Image image;
  float display_scale = 1;
};

/// Another view of a rendered document, by as many samples as the render had: from the film where that holds
/// them, by passes of their own otherwise.
ViewPicture render_view(const Document& document, const OfflineResult& rendered, View view,
                        const OfflineOptions& options = {});

} // namespace candela
