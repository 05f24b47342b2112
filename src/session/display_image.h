#pragma once
// A tone-mapped picture of a session.

#include "imaging/display_transform.h"
#include "render/film/frame.h"
#include "session/denoise_thread.h"

namespace candela {

/// Ready for glTexImage2D as RGBA8.
struct DisplayImage {
  std::shared_ptr<const Frame> frame;            ///< its source ...
  std::shared_ptr<const DenoisedImage> denoised; ///< ... or this one of the same accumulation, if not null
  DisplaySettings display;                       ///< the settings it was made with
  DisplayTransform transform;                    ///< their transform for this frame
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba; ///< row 0 is the top

  /// The image that was tone-mapped.
  const std::vector<vec3>& linear() const { return denoised ? denoised->linear : frame->linear; }
};

} // namespace candela
