#pragma once

#include "sampling/sampler.h"

namespace candela {

/// Where a lesson's random numbers come from: a stream is what one pixel of the renderer gets, so that any
/// draw can be made again, alone.
struct SampleSource {
  SamplerType type = SamplerType::sobol;
  std::uint64_t seed = 0;
  int strata = 4; ///< a side, of the stratified sampler
  bool operator==(const SampleSource&) const = default;

  /// Of a stream; those of different streams are independent, as neighbours of blue noise are not.
  static uvec2 pixel(int stream) { return {static_cast<std::uint32_t>(stream) * kBlueNoiseTile, 0}; }
  Sampler sampler() const { return Sampler(type, seed, strata); }
};

} // namespace candela
