#pragma once
// The point sequences behind the samplers. Each function gives one point of the sequence that a key chooses,
// from the point's number alone; a key stands for a seed, pixel, bounce and dimension.
//
// All of them are of small bases and padded: every dimension has a two-dimensional sequence of its own, and
// an order of its own in which it is run through. The other way, one sequence of many dimensions, needs ever
// larger bases (Halton) or direction numbers (Sobol'), and their projections are no better than chance until
// base^2 samples; a path at 64 samples never gets there.

#include "core/hash.h"
#include "core/math.h"

#include <bit>

namespace candela {

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

/// The transposed matrix, a sum over subsets of bit positions: bit n of the result is the sum of C(n, j)
/// times bit j. Any k consecutive rows are a regular matrix in the first k columns, for the binomials C(n,
/// 0..k-1) are a basis of the polynomials in n of degree below k.
constexpr std::uint32_t pascal_transposed(std::uint32_t x) {
  x ^= (x & 0x55555555u) << 1;
  x ^= (x & 0x33333333u) << 2;
  x ^= (x & 0x0f0f0f0fu) << 4;
  x ^= (x & 0x00ff00ffu) << 8;
  x ^= x << 16;
  return x;
}

/// Bits of x at even, of y at odd places, 16 of each: neighbours on the film are neighbours in the order that
/// it counts (Morton 1966).
constexpr std::uint32_t morton_code(std::uint32_t x, std::uint32_t y) {
  auto spread = [](std::uint32_t v) {
    v &= 0xffffu;
    v = (v | (v << 8)) & 0x00ff00ffu;
    v = (v | (v << 4)) & 0x0f0f0f0fu;
    v = (v | (v << 2)) & 0x33333333u;
    return (v | (v << 1)) & 0x55555555u;
  };
  return spread(x) | (spread(y) << 1);
}

constexpr std::uint32_t high_bits(std::uint64_t h) { return static_cast<std::uint32_t>(h >> 32); }
constexpr std::uint32_t low_bits(std::uint64_t h) { return static_cast<std::uint32_t>(h); }

/// Radical inverse of `index` in base 2, as a fraction of 2^32, with Owen's nested uniform scrambling (Owen
/// 1995, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences") by a hash per node that is visited, built as
/// Helmer, Christensen & Kensler 2021 ("Stochastic Generation of (t, s) Sample Sequences") do: a point takes
/// its leading digits from the point without its index's last bit, goes to the other half there, and what
/// follows is random.
constexpr std::uint32_t scrambled_radical_inverse_2(std::uint32_t index, std::uint64_t seed) {
  std::uint32_t value = high_bits(hash_combine(seed, 0));
  for (std::uint32_t rest = index; rest != 0; rest &= rest - 1) {
    std::uint32_t bit = rest & (0 - rest);
    std::uint32_t place = 0x80000000u >> std::countr_zero(rest);
    std::uint32_t fresh = high_bits(hash_combine(seed, index & (bit | (bit - 1))));
    value = ((value ^ place) & (0 - place)) | (fresh & (place - 1));
  }
  return value;
}

/// The same in base 3. `tail` is the fraction that follows if no more digits do; its leading digit in base 3
/// is where the node sends a digit of 0, and the node's hash says which of the other two is next.
constexpr std::uint32_t scrambled_radical_inverse_3(std::uint64_t index, std::uint64_t seed) {
  constexpr std::uint64_t kEnough = 43046721; // 3^16: more than 24 bits
  std::uint32_t tail = high_bits(hash_combine(seed, 0));
  std::uint64_t digits = 0, power = 1, prefix = 0;
  for (std::uint64_t rest = index; rest != 0 && power < kEnough; rest /= 3, power *= 3) {
    std::uint64_t digit = rest % 3, scaled = static_cast<std::uint64_t>(tail) * 3;
    std::uint64_t to = scaled >> 32;
    tail = low_bits(scaled);
    if (digit != 0) {
      std::uint64_t node = hash_combine(seed + power, prefix);
      to = (to + ((node & 1) != 0 ? digit : 3 - digit)) % 3;
      tail = digit == 1 ? high_bits(node) : low_bits(node);
      prefix += digit * power;
    }
    digits = digits * 3 + to;
  }
  return static_cast<std::uint32_t>(((digits << 32) | tail) / power);
}

/// A nested shuffle of sample numbers in the mixed radix 2, 3, 2, 3, ...: aligned runs of 6^k and of 2 6^k
/// numbers stay together, and within each the halves or thirds come in a random order. What lies below stays
/// below: a prefix is mapped to itself up to its leading digit.
constexpr std::uint64_t shuffle_by_sixes(std::uint32_t sample, std::uint64_t seed) {
  std::uint64_t result = 0, weight = 1;
  std::uint32_t rest = sample;
  do {
    std::uint32_t pair = rest % 6 / 2, second = rest % 2;
    rest /= 6;
    std::uint64_t h = hash_combine(seed + weight, rest);
    auto first = static_cast<std::uint32_t>(static_cast<std::uint64_t>(high_bits(h)) * 3 >> 32);
    second ^= static_cast<std::uint32_t>(h >> pair) & 1;
    pair = (first + ((h & 8) != 0 ? pair : 3 - pair)) % 3;
    result += weight * (2 * pair + second);
    weight *= 6;
  } while (rest >= 6);
  return result + weight * rest;
}

/// Halton's sequence in the bases 2 and 3, scrambled (Halton 1960; Owen 1995), with the shuffle above. Every
/// dimension has these two bases.
vec2 halton_point(std::uint64_t key, std::uint32_t sample);

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

/// A progressive multi-jittered (0,2)-sequence (Christensen, Kensler & Kilpatrick 2018, "Progressive
/// Multi-Jittered Sample Sequences"), built one point at a time as Helmer, Christensen & Kensler 2021 show:
/// each point goes to the half of its interval, in x and in y, that an earlier point left empty, and to a
/// random place there. For the second coordinate the same recursion runs on the Sobol' matrix's index.
/// Nothing but the quality of its randomness differs from sobol_point(): a hash per node, not per bit.
vec2 pmj02_point(std::uint64_t key, std::uint32_t sample, std::uint32_t reversed_sample);

/// Second component a of the lattice's generating vector (1, a). Two figures of merit are good for each of
/// the lattices of n = 2^m points, m <= 32. The shortest vector is at least 0.52 of what the hexagonal
/// lattice, the best of all, has: points keep their distance. The least product |h1 h2| of a wave (h1, h2)
/// that the points take for a constant (Zaremba's index; of zeros as ones) is at least 0.057 n: error bounds
/// for functions that are not periodic go with n / it. Found by extending a from its lowest bit, keeping the
/// best million.
inline constexpr std::uint32_t kLatticeGenerator = 0x7519348du;

/// A rank-1 lattice sequence in base 2 (Hickernell, Hong, L'Ecuyer & Lemieux 2000, "Extensible Lattice
/// Sequences for Quasi-Monte Carlo Quadrature"): phi_2(i) (1, a) mod 1, moved by a random shift (Cranley &
/// Patterson 1976, "Randomization of Number Theoretic Methods for Multiple Integration"). Each aligned run of
/// 2^m samples is a moved lattice, in a random order.
inline vec2 lattice_point(std::uint64_t key, std::uint32_t reversed_sample) {
  // The radical inverse of the shuffled number is its reversed bits, as a fraction of 2^32.
  std::uint64_t seed = hash64(key + 1);
  std::uint32_t inverse = laine_karras(reversed_sample, high_bits(seed));
  return {to_unit_float(inverse + low_bits(key)),
          to_unit_float(inverse * kLatticeGenerator + high_bits(key))};
}

/// Pixels a side of the squares that share their sequences with blue_noise. The mean over a square is far
/// more exact than a pixel already, so nothing is gained by larger ones; but the squares' errors are
/// independent, so that no bad luck of one scramble shows on the whole film.
inline constexpr std::uint32_t kBlueNoiseTile = 16;

/// One sequence for a tile of pixels, so that the errors of neighbouring pixels cancel: what is left of the
/// error lies at high frequencies, where the eye, a filter or a denoiser loses it. That it takes runs of
/// points along a hierarchical order of pixels is from Ahmed & Wonka 2020, "Screen-Space Blue-Noise Diffusion
/// of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels"; they give each pixel 2^L numbers of
/// its own, so that L must be known and only all of the 2^L samples are well distributed over neighbours.
/// Here, pixel m (along the Morton curve) and sample s are digits of the same point over GF(2),
///     x = s + T m,   y = P s + T P m   (bits reversed),
/// with P Sobol's second matrix and T Pascal's triangle transposed, and Owen-scrambled for the whole tile.
/// For each pixel this is the (0,2)-sequence of sobol_point, only shifted. At one sample, the 4^k pixels of
/// each aligned square have a (0, 2k, 2)-net. At 2^L samples, known in advance or not, each of their
/// coordinates is a (0, L + 2k, 1)-net: of the L + 2k leading bits s makes the first L, and T makes the
/// others run through all values with m (see pascal_transposed). A net of both coordinates at every L cannot
/// be: for two pixels at two samples it would take four different lines of the plane over GF(2), which has
/// three. So the gain is largest at few samples, and it is for smooth integrands, as that of all such points.
vec2 blue_noise_point(std::uint64_t key, std::uint32_t reversed_sample, std::uint32_t reversed_morton);

} // namespace candela
