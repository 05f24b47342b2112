#pragma once
// Sampling in proportion to tabulated weights.

#include "core/hash.h"
#include "core/math.h"

#include <span>
#include <vector>

namespace candela {

/// Discrete distribution over 0..size-1 with constant-time draws: Walker's alias method, table by Vose 1991,
/// "A Linear Algorithm for Generating Random Numbers with a Given Distribution".
class AliasTable {
public:
  struct Sample {
    std::uint32_t index;
    float pmf;
    float u; ///< what is left of the random number, uniform in [0, 1) again with log2(size) digits fewer
  };

  AliasTable() = default;
  /// Weights are finite and not negative (else std::invalid_argument) and need not sum to 1. Where all are 0
  /// the table is empty.
  explicit AliasTable(std::span<const float> weights);

  bool empty() const { return bins_.empty(); }
  std::size_t size() const { return bins_.size(); }
  /// Probability of an index; a weight of 0 is never drawn.
  float pmf(std::uint32_t index) const { return bins_[index].pmf; }

  /// u in [0, 1); the table must not be empty. A float's 24 bits leave each of n bins 2^24 / n values.
  Sample sample(float u) const { return sample_bits(static_cast<std::uint32_t>(u * 0x1p32f)); }
  /// The same from 32 uniform bits.
  Sample sample_bits(std::uint32_t bits) const {
    std::uint64_t scaled = static_cast<std::uint64_t>(bits) * bins_.size();
    auto index = static_cast<std::uint32_t>(scaled >> 32);
    float rest = to_unit_float(static_cast<std::uint32_t>(scaled)); // below 1, so below a threshold of 1
    const Bin& bin = bins_[index];
    if (rest < bin.threshold) return {index, bin.pmf, std::min(rest / bin.threshold, kOneMinusEpsilon)};
    float u = (rest - bin.threshold) / (1 - bin.threshold);
    return {bin.alias, bins_[bin.alias].pmf, std::min(u, kOneMinusEpsilon)};
  }

private:
  struct Bin {
    float threshold; ///< share of the bin that is its own; the rest is its alias's
    float pmf;
    std::uint32_t alias;
  };
  std::vector<Bin> bins_;
};

/// Density on [0, 1) that is constant in each of size() equal cells, by inversion of its distribution
/// function.
class PiecewiseConstant1D {
public:
  struct Sample {
    float x;   ///< in [0, 1)
    float pdf; ///< per unit length
    std::uint32_t cell;
  };

  PiecewiseConstant1D() = default;
  /// Weights as of AliasTable, at least one; where all are 0 the density is uniform, and integral() is 0.
  explicit PiecewiseConstant1D(std::span<const float> weights);

  std::size_t size() const { return pdf_.size(); }
  /// Of the weights as a function on [0, 1): their mean.
  float integral() const { return integral_; }
  /// x in [0, 1).
  std::size_t cell_of(float x) const { // the product of the two is exact in double precision
    return static_cast<std::size_t>(static_cast<double>(x) * static_cast<double>(size()));
  }
  float pdf(float x) const { return pdf_[cell_of(x)]; }
  Sample sample(float u) const;

private:
  std::vector<float> cdf_; ///< size() + 1 values from 0 to 1
  std::vector<float> pdf_;
  float integral_ = 0;
};

} // namespace candela
