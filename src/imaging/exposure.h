#pragma once
// Exposure found from the picture itself.

#include "core/math.h"

#include <span>

namespace candela {

/// What a picture's mean brightness is exposed to: the key of Reinhard et al. 2002, the reflectance of a grey
/// card.
inline constexpr float kMiddleGrey = 0.18f;

/// The exposure (stops) at which the picture's log-average luminance becomes kMiddleGrey (Reinhard, Stark,
/// Shirley and Ferwerda, "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, eq. 1-2). The
/// logarithms are not of pixels but of means over the cells of a grid of at most 64 x 64: a pixel of one
/// sample is mostly noise, of which the logarithm has another mean, so that the exposure would creep while
/// the picture refines. Black cells are left out (the paper adds a small constant instead, which has a unit);
/// 0 where all are. Depends on nothing but the pixels, so a file is exposed as the window is.
float automatic_exposure(std::span<const vec3> linear, int width, int height);

} // namespace candela
