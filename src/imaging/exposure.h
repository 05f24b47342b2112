#pragma once
// Automatic exposure.

#include "core/math.h"

#include <span>

namespace candela {

/// The target of a picture's mean brightness: the key of Reinhard et al. 2002, the reflectance of a grey
/// card.
inline constexpr float kMiddleGrey = 0.18f;

/// The exposure (stops) at which the picture's log-average luminance becomes kMiddleGrey (Reinhard, Stark,
/// Shirley and Ferwerda, "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, eq. 1-2). The
/// logarithms are of means over the cells of a grid of at most 64 x 64 rather than of pixels: noise changes
/// the mean of logarithms, so that the exposure would drift while the picture refines. Black cells are left
/// out (the paper adds a small constant instead, which has a unit); 0 where all are. Depends only on the
/// pixels, so files are exposed like the window.
float automatic_exposure(std::span<const vec3> linear, int width, int height);

} // namespace candela
