#pragma once
// The random numbers of a render. There is no state to advance: each is a function of (seed, pixel, sample,
// bounce, dimension, index), so that any path can be traced again alone, and threads, tiles and order cannot
// matter.

#include "core/hash.h"
#include "core/math.h"
#include "sampling/sampler_type.h"

#include <array>
#include <bit>

namespace candela {

/// What a number is for; two draws at one bounce must differ in this or in their index.
enum class Dimension : std::uint32_t {
  film,             ///< position within the pixel's filter
  lens,             ///< position on the aperture
  light_choice,     ///< which light next-event estimation asks
  light_position,   ///< where on it
  bsdf_lobe,        ///< which lobe scatters
  bsdf_direction,   ///< where to
  russian_roulette, ///< whether the path goes on
  opacity,          ///< whether light meets a partly transparent surface
  count
};

/// Elementary intervals of base 2 stay intact: bit k of the result depends on bits 0..k of x only, and flips
/// at random with them. Between two bit reversals this is Owen's nested uniform scrambling (Laine & Karras
/// 2011, "Stratified Sampling for Stochastic Transparency"; constants by Vegdahl 2021, "Building a Better LK
/// Hash").
constexpr std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  return x;
}

/// The second Sobol' dimension with its bits reversed (the first one is `index` itself). Its generator matrix
/// is Pascal's triangle mod 2, and by Lucas' theorem C(k, j) is odd exactly where the bits of j are a subset
/// of k's: a sum over supersets of bit positions, which factors into five butterfly steps.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= index >> 16;
  return index;
}

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

/// The Owen-scrambled (0, 2)-sequence that `key` and `dimension` choose, at a sample number whose bits are
/// reversed. 32-bit operations only, which every vector unit has.
inline vec2 sobol_point(std::uint64_t key, std::uint32_t reversed_sample, std::uint32_t dimension) {
  std::uint32_t shuffle_seed = hash32(static_cast<std::uint32_t>(key) + dimension * 0x9e3779b9u);
  std::uint32_t x_seed = hash32(shuffle_seed ^ static_cast<std::uint32_t>(key >> 32));
  std::uint32_t y_seed = (x_seed ^ (x_seed >> 15)) * 0x2c1b3c6du;
  y_seed ^= y_seed >> 13;
  // The nested uniform shuffle of the sample number: aligned runs of 2^m stay together, but which of two
  // halves comes first is random, so that dimensions padded beside each other are not correlated.
  std::uint32_t i = reverse_bits(laine_karras(reversed_sample, shuffle_seed));
  // Scrambling works on reversed bits, and the first Sobol' dimension is the reversed index.
  std::uint32_t x = reverse_bits(laine_karras(i, x_seed));
  std::uint32_t y = reverse_bits(laine_karras(sobol_second_reversed(i), y_seed));
  return {to_unit_float(x), to_unit_float(y)};
}

/// Every value is in [0, 1). Pixels, bounces, dimensions and indices are independent of each other; within
/// one of them the samples 0, 1, 2, … of a pixel are spread as the type says, and any number of them may be
/// used.
///
/// stratified: each run of strata^2 samples has one in every cell of a strata x strata grid (of strata^2
/// intervals in 1-D), jittered and in an order of its own.
///
/// sobol: each aligned run of 2^m samples is a (0, m, 2)-net in base 2 (a (0, m, 1)-net in 1-D): one point in
/// every elementary interval of size 2^-m (Burley 2020, "Practical Hash-based Owen Scrambling": padded 2-D
/// sequences with a nested uniform shuffle of the index).
class Sampler {
public:
  /// `strata` is a side of the stratified sampler's grid, in [1, 65535].
  Sampler(SamplerType type, std::uint64_t seed, int strata = 4)
      : type_(type == SamplerType::independent || type == SamplerType::stratified ? type
                                                                                  : SamplerType::sobol),
        strata_(static_cast<std::uint32_t>(strata)), seed_(hash_combine(0, seed)) {
    start({0, 0}, 0);
  }

  /// Goes to a pixel's sample, at bounce 0.
  void start(uvec2 pixel, std::uint32_t sample) {
    pixel_key_ = hash_combine(seed_, (static_cast<std::uint64_t>(pixel.y) << 32) | pixel.x);
    sample_ = sample;
    if (type_ == SamplerType::independent) {
      pixel_key_ = hash_combine(pixel_key_, sample);
    } else if (type_ == SamplerType::sobol) {
      reversed_sample_ = reverse_bits(sample);
    } else {
      std::uint32_t cells = strata_ * strata_;
      block_ = sample / cells;
      sample_in_block_ = sample % cells;
    }
    set_bounce(0);
  }

  void set_bounce(std::uint32_t bounce) {
    bounce_key_ = hash_combine(pixel_key_, bounce);
    if (type_ == SamplerType::sobol) make_sobol_points();
  }

  /// The `index`-th of repeated draws for one purpose (several light samples at a vertex). A dimension is
  /// drawn in 1-D or in 2-D, not both: they are not independent.
  float get_1d(Dimension dimension, std::uint32_t index = 0) const {
    if (type_ != SamplerType::stratified) return get_2d(dimension, index).x;
    std::uint32_t cells = strata_ * strata_;
    StratifiedDraw draw = stratified_draw(dimension, index);
    return in_cell(draw.cell, cells, high(draw.jitter));
  }

  vec2 get_2d(Dimension dimension, std::uint32_t index = 0) const {
    switch (type_) {
    case SamplerType::independent: {
      std::uint64_t h = key(dimension, index);
      return {to_unit_float(high(h)), to_unit_float(low(h))};
    }
    case SamplerType::stratified: {
      StratifiedDraw draw = stratified_draw(dimension, index);
      return {in_cell(draw.cell % strata_, strata_, high(draw.jitter)),
              in_cell(draw.cell / strata_, strata_, low(draw.jitter))};
    }
    default: break;
    }
    auto d = static_cast<std::uint32_t>(dimension);
    if (index == 0) return {x_[d], y_[d]};
    return sobol_point(hash_combine(bounce_key_, index), reversed_sample_, d);
  }

private:
  static constexpr std::size_t kDimensions = static_cast<std::size_t>(Dimension::count);

  static std::uint32_t high(std::uint64_t h) { return static_cast<std::uint32_t>(h >> 32); }
  static std::uint32_t low(std::uint64_t h) { return static_cast<std::uint32_t>(h); }

  std::uint64_t key(Dimension dimension, std::uint32_t index) const {
    return hash_combine(bounce_key_,
                        (static_cast<std::uint64_t>(index) << 32) | static_cast<std::uint64_t>(dimension));
  }

  /// All of a bounce's points, x_ and y_, in one loop over the dimensions that the compiler vectorises: for
  /// the four or five that a bounce needs this is half the cost of making each when asked for. Not inline,
  /// for where it is inlined clang unrolls the loop instead.
  void make_sobol_points();

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
  std::uint32_t reversed_sample_ = 0;             ///< sobol
  std::uint32_t block_ = 0, sample_in_block_ = 0; ///< stratified
  std::uint64_t seed_;
  std::uint64_t pixel_key_ = 0; ///< has the sample in it if independent
  std::uint64_t bounce_key_ = 0;
  std::array<float, kDimensions> x_{}, y_{}; ///< sobol: the bounce's points of index 0
};

} // namespace candela
