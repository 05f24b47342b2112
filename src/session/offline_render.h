#pragma once
// A render from start to finish, as the command line does it: the same passes as the window's, in larger
// portions.

#include "render/render_pass.h"

#include <functional>

namespace candela {

struct OfflineProgress {
  int spp = 0; ///< complete passes
  double render_seconds = 0;
  double fraction = 0; ///< towards the nearest stopping criterion, 0..1
  RayCounts rays;
};

struct OfflineOptions {
  PassOptions pass;
  const std::atomic<bool>* stop = nullptr; ///< ends early, between tiles; the film keeps what it has
  std::function<void(const OfflineProgress&)> progress; ///< called after each portion
};

struct OfflineResult {
  Film film;
  int spp = 0; ///< complete passes
  double build_seconds = 0;
  double render_seconds = 0;
  RayCounts rays;
  NonFiniteLog nonfinite;
  float display_scale = 1;
  std::size_t scene_bytes = 0;
  bool interrupted = false; ///< by `stop`
};

/// Renders until the document's stop.spp or stop.time, whichever comes first (one sample a pixel at least).
/// Throws a usage error where the document has neither.
OfflineResult render_document(const Document& document, const OfflineOptions& options = {});

} // namespace candela
