#pragma once
// The FLIP difference of two pictures that alternate on a screen.

#include "imaging/image.h"

#include <vector>

namespace candela {

/// Pixels per degree of visual angle: a 0.7 m wide screen of 3840 pixels seen from 0.7 m, the paper's
/// default.
inline constexpr float kFlipPixelsPerDegree = 67.0206f;

/// The FLIP error of every pixel, from 0 (no difference) to 1, row 0 is the top: Andersson, Nilsson,
/// Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating Images",
/// Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020 (the paper's LDR-FLIP). The pictures are linear
/// Rec. 709, clipped to [0, 1] (NaN to 0) but not rounded to 8 bits, and must have equal sizes. Beyond the
/// border pixels repeat. The result is the same with the pictures exchanged.
std::vector<float> flip_map(const Image& a, const Image& b, float pixels_per_degree = kFlipPixelsPerDegree);

} // namespace candela
