#pragma once
// The random numbers of a render. They have no state: each is a function of (seed, pixel, sample, bounce,
// dimension, index), so that any single path can be traced again, independent of threads, tiles and order.

#include "core/hash.h"
#include "core/math.h"
#include "sampling/sampler_type.h"
#include "sampling/sequences.h"

#include <array>
#include <bit>
#include <span>

namespace candela {

/// What a number is for; two draws at one bounce must differ in this or in their index.
enum class Dimension : std::uint32_t {
  film,             ///< position within the pixel's filter
  lens,             ///< position on the aperture
  light_position,   ///< which light next-event estimation samples, and where on it
  bsdf_lobe,        ///< which lobe scatters
  bsdf_direction,   ///< where to
  russian_roulette, ///< whether the path continues
  opacity,          ///< whether a ray hits a partly transparent surface
  time,             ///< when between the opening and the closing of the shutter
  medium_distance,  ///< where in media a ray collides
  medium_direct,    ///< where in media lights are sampled
  medium_pivot,     ///< near which place on which light that is
  medium_tracking,  ///< tentative collisions in grids
  subsurface_probe, ///< which way a ray goes that looks for exit points, and which of them is taken
  subsurface_point, ///< where it goes
  count
};

/// Position of `index` in a pseudo-random permutation of 0..length-1 that `key` chooses; index < length.
/// Cycle walking over an invertible hash of the next power of two (Kensler 2013, "Correlated Multi-Jittered
/// Sampling", section 3). x (2 x + odd) is invertible modulo 2^k, as in the cipher RC6; six rounds and shifts
/// that vary make the orders of even four elements equally likely.
constexpr std::uint32_t permute(std::uint32_t index, std::uint32_t length, std::uint64_t key) {
  if (length <= 1) return 0;
  auto bits = static_cast<std::uint32_t>(std::bit_width(length - 1));
  std::uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
  do {
    std::uint64_t k = key;
    for (int round = 0; round < 6; ++round) {
      k = k * 0xd1342543de82ef95ull + 0x9e3779b97f4a7c15ull;
      index += static_cast<std::uint32_t>(k >> 32);
      index = (index * (2 * index + (static_cast<std::uint32_t>(k >> 20) | 1))) & mask;
      std::uint32_t shift = 1 + ((static_cast<std::uint32_t>(k >> 16) & 0xffff) * bits >> 16); // 1..bits
      index ^= static_cast<std::uint32_t>(static_cast<std::uint64_t>(index) >> shift);
    }
    index = (index + static_cast<std::uint32_t>(k >> 40)) & mask;
  } while (index >= length);
  return index;
}

/// Every value is in [0, 1). Pixels (but for blue_noise), bounces, dimensions and indices are independent of
/// each other; within one of them the samples 0, 1, 2, … of a pixel are distributed as the type says, and any
/// number of them may be used. A run is aligned if its first number is a multiple of its length. One
/// dimension is a point's x.
///
/// stratified: each run of strata^2 samples has one in every cell of a strata x strata grid (of strata^2
/// intervals in 1-D), jittered and in an order of its own.
///
/// sobol, pmj02, blue_noise: each aligned run of 2^m samples is a (0, m, 2)-net in base 2 (a (0, m, 1)-net in
/// 1-D): one point in every elementary interval of size 2^-m (Burley 2020, "Practical Hash-based Owen
/// Scrambling": padded 2-D sequences with a nested uniform shuffle of the index). blue_noise has that among
/// neighbouring pixels, too, as blue_noise_point() says.
///
/// halton: each aligned run of 6^k samples has one in every box of 2^-k x 3^-k, each of 2 6^k one in every
/// box of 2^-(k+1) x 3^-k; bases 2 and 3 in every dimension.
///
/// lattice: each aligned run of 2^m samples is a randomly moved rank-1 lattice.
class Sampler {
public:
  /// `strata` is a side of the stratified sampler's grid, in [1, 65535].
  Sampler(SamplerType type, std::uint64_t seed, int strata = 4)
      : type_(type), strata_(static_cast<std::uint32_t>(strata)), seed_(hash_combine(0, seed)) {
    start({0, 0}, 0);
  }

  /// Goes to a pixel's sample, at bounce 0.
  void start(uvec2 pixel, std::uint32_t sample) {
    pixel_key_ = hash_combine(seed_, (static_cast<std::uint64_t>(pixel.y) << 32) | pixel.x);
    if (type_ == SamplerType::blue_noise) {
      reversed_morton_ = reverse_bits(morton_code(pixel.x % kBlueNoiseTile, pixel.y % kBlueNoiseTile));
      pixel_key_ = hash_combine(seed_, (static_cast<std::uint64_t>(pixel.y / kBlueNoiseTile) << 32) |
                                           pixel.x / kBlueNoiseTile);
    }
    set_sample(sample);
    set_bounce(0);
  }

  std::uint32_t sample() const { return sample_; }

  /// For the k-th of `count` branches that a sample divides into: the branches of samples 0, 1, 2, ... are
  /// the samples k + count * 0, 1, 2, ... of one sequence, as well distributed as that. Numbers drawn before,
  /// for one purpose and at one bounce, must not be drawn again.
  Sampler branch(std::uint32_t k, std::uint32_t count) const {
    Sampler s = *this;
    if (type_ == SamplerType::independent)
      s.bounce_key_ = hash_combine(bounce_key_, k), s.pixel_key_ = hash_combine(pixel_key_, k);
    else
      s.set_sample(sample_ * count + k);
    return s;
  }

  void set_bounce(std::uint32_t bounce) { bounce_key_ = hash_combine(pixel_key_, bounce); }

  /// The `index`-th of repeated draws for one purpose (surfaces that a ray passes by opacity). A dimension is
  /// drawn in 1-D or in 2-D, not both: they are not independent.
  float get_1d(Dimension dimension, std::uint32_t index = 0) const {
    if (type_ != SamplerType::stratified) return get_2d(dimension, index).x;
    std::uint32_t cells = strata_ * strata_;
    StratifiedDraw draw = stratified_draw(dimension, index);
    return in_cell(draw.cell, cells, high_bits(draw.jitter));
  }

  vec2 get_2d(Dimension dimension, std::uint32_t index = 0) const {
    switch (type_) {
    case SamplerType::independent: {
      std::uint64_t h = key(dimension, index);
      return {to_unit_float(high_bits(h)), to_unit_float(low_bits(h))};
    }
    case SamplerType::stratified: {
      StratifiedDraw draw = stratified_draw(dimension, index);
      return {in_cell(draw.cell % strata_, strata_, high_bits(draw.jitter)),
              in_cell(draw.cell / strata_, strata_, low_bits(draw.jitter))};
    }
    case SamplerType::halton: return halton_point(key(dimension, index), sample_);
    case SamplerType::pmj02: return pmj02_point(key(dimension, index), sample_, reversed_sample_);
    case SamplerType::lattice: return lattice_point(key(dimension, index), reversed_sample_);
    case SamplerType::blue_noise:
      return blue_noise_point(key(dimension, index), reversed_sample_, reversed_morton_);
    case SamplerType::sobol: break;
    }
    return sobol_point(sobol_key(index), reversed_sample_, static_cast<std::uint32_t>(dimension));
  }

  /// A draw of one of many samplers.
  struct Draw {
    const Sampler* sampler;
    std::uint32_t index;
  };
  /// get_2d(dimension, draws[i].index) of draws[i].sampler, all of one type. Sobol' points are made side by
  /// side by the vector unit, several at a time.
  static void get_2d(std::span<const Draw> draws, Dimension dimension, std::span<vec2> points);
  /// The same of get_1d.
  static void get_1d(std::span<const Draw> draws, Dimension dimension, std::span<float> points);

private:
  void set_sample(std::uint32_t sample) {
    sample_ = sample;
    switch (type_) {
    case SamplerType::independent: pixel_key_ = hash_combine(pixel_key_, sample); break;
    case SamplerType::stratified:
      block_ = sample / (strata_ * strata_);
      sample_in_block_ = sample % (strata_ * strata_);
      break;
    case SamplerType::halton: break;
    case SamplerType::sobol:
    case SamplerType::pmj02:
    case SamplerType::lattice:
    case SamplerType::blue_noise: reversed_sample_ = reverse_bits(sample); break;
    }
  }

  std::uint64_t key(Dimension dimension, std::uint32_t index) const {
    return hash_combine(bounce_key_,
                        (static_cast<std::uint64_t>(index) << 32) | static_cast<std::uint64_t>(dimension));
  }

  std::uint64_t sobol_key(std::uint32_t index) const {
    return index == 0 ? bounce_key_ : hash_combine(bounce_key_, index);
  }

  struct StratifiedDraw {
    std::uint32_t cell; ///< of strata^2
    std::uint64_t jitter;
  };
  StratifiedDraw stratified_draw(Dimension dimension, std::uint32_t index) const {
    std::uint64_t h = key(dimension, index);
    std::uint64_t block_key = hash_combine(h, block_);
    return {permute(sample_in_block_, strata_ * strata_, block_key), hash_combine(~h, sample_)};
  }
  /// (cell + jitter / 2^32) / cells, rounded down: floats would round some points into the next cell.
  static float in_cell(std::uint32_t cell, std::uint32_t cells, std::uint32_t jitter) {
    std::uint64_t scaled = (static_cast<std::uint64_t>(cell) << 32) | jitter;
    return to_unit_float(static_cast<std::uint32_t>(scaled / cells));
  }

  SamplerType type_;
  std::uint32_t strata_;
  std::uint32_t sample_ = 0;
  std::uint32_t reversed_sample_ = 0;             ///< of the samplers in base 2
  std::uint32_t reversed_morton_ = 0;             ///< blue_noise
  std::uint32_t block_ = 0, sample_in_block_ = 0; ///< stratified
  std::uint64_t seed_;
  std::uint64_t pixel_key_ =
      0; ///< has the sample in it if independent, and the tile for the pixel if blue_noise
  std::uint64_t bounce_key_ = 0;
};

} // namespace candela
