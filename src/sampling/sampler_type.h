#pragma once

namespace candela {

/// How the random numbers of a pixel are distributed (sampling/sampler.h).
enum class SamplerType : int {
  independent, ///< each number on its own
  stratified,  ///< jittered cells, permuted per pixel and dimension
  halton,      ///< radical inverses, scrambled per pixel and dimension
  sobol,       ///< padded, Owen-scrambled Sobol' (0,2)-sequences
  pmj02,       ///< progressive multi-jittered (0,2)-sequences
  lattice,     ///< a rank-1 lattice sequence, shifted per pixel and dimension
  blue_noise,  ///< Sobol' along a space-filling order of the pixels: the error looks like blue noise
};

} // namespace candela
