#pragma once
// The denoised picture of a render that is done.

#include "session/offline_render.h"

#include <optional>

namespace candela {

struct DenoisedPicture {
  Image image;    ///< of what the film holds
  double seconds; ///< features and all
};

/// Where the document asks for one; warns on stderr where there is nothing to make it from.
std::optional<DenoisedPicture> denoised_picture(const Document& document, const OfflineResult& result,
                                                const PassOptions& pass);

} // namespace candela
