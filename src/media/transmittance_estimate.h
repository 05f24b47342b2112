#pragma once

#include "core/spectrum.h"

namespace candela {

/// What passes a stretch of a ray.
struct TransmittanceEstimate {
  Spectrum value; ///< the share of light that does, or an unbiased estimate of it
  /// About what a medium that scatters lets pass, 1 where it does not scatter. It has no randomness: for the
  /// weights of strategies, which must agree on it.
  Spectrum expected;
};

} // namespace candela
