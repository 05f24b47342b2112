#pragma once
// Denoising of a finished render.

#include "session/offline_render.h"

#include <optional>

namespace candela {

struct DenoisedPicture {
  Image image;    ///< of the film
  double seconds; ///< including the features
};

/// The denoised picture, if the document asks for one; warns on stderr if there are too few samples.
std::optional<DenoisedPicture> denoised_picture(const Document& document, const OfflineResult& result,
                                                const PassOptions& pass);

} // namespace candela
