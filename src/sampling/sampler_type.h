#pragma once

namespace candela {

/// How the random numbers of a pixel are spread (sampling/sampler.h).
enum class SamplerType : int {
  independent, ///< each number on its own
  stratified,  ///< jittered cells, permuted per pixel and dimension
  sobol,       ///< padded, Owen-scrambled Sobol' (0,2)-sequences
};

} // namespace candela
