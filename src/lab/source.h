#pragma once

#include "sampling/sampler.h"

namespace candela {

/// The source of a lesson's random numbers. A stream is that of one pixel of the renderer, so that single
/// draws can be repeated.
struct SampleSource {
  SamplerType type = SamplerType::sobol;
  std::uint64_t seed = 0;
  int strata = 4; ///< a side, of the stratified sampler
  bool operator==(const SampleSource&) const = default;

  /// The sampler of a stream. Streams are independent, unlike neighbouring pixels with blue noise.
  static uvec2 pixel(int stream) { return {static_cast<std::uint32_t>(stream) * kBlueNoiseTile, 0}; }
  Sampler sampler() const { return Sampler(type, seed, strata); }
};

} // namespace candela
