#include "sampling/sequences.h"

namespace candela {

vec2 halton_point(std::uint64_t key, std::uint32_t sample) {
  std::uint64_t i = shuffle_by_sixes(sample, key), seeds = hash64(key + 1);
  std::uint32_t x = reverse_bits(laine_karras(static_cast<std::uint32_t>(i), high_bits(seeds)));
  return {to_unit_float(x), to_unit_float(scrambled_radical_inverse_3(i, seeds))};
}

vec2 pmj02_point(std::uint64_t key, std::uint32_t sample, std::uint32_t reversed_sample) {
  // A nested shuffle, but the leading bit stays: the recursions are as long as the index has bits set.
  std::uint32_t leading = std::bit_floor(sample);
  std::uint32_t shuffled = reverse_bits(laine_karras(reversed_sample, high_bits(key)));
  std::uint32_t i = leading == 0 ? 0 : (shuffled & (leading - 1)) | leading;
  return {to_unit_float(scrambled_radical_inverse_2(i, hash64(key + 1))),
          to_unit_float(scrambled_radical_inverse_2(sobol_second_reversed(i), hash64(key + 2)))};
}

vec2 blue_noise_point(std::uint64_t key, std::uint32_t reversed_sample, std::uint32_t reversed_morton) {
  std::uint64_t seeds = hash64(key + 1);
  std::uint32_t s = reverse_bits(laine_karras(reversed_sample, low_bits(key)));
  std::uint32_t m = reverse_bits(laine_karras(reversed_morton, high_bits(key)));
  std::uint32_t x = s ^ pascal_transposed(m);
  std::uint32_t y = sobol_second_reversed(s) ^ pascal_transposed(sobol_second_reversed(m));
  return {to_unit_float(reverse_bits(laine_karras(x, high_bits(seeds)))),
          to_unit_float(reverse_bits(laine_karras(y, low_bits(seeds))))};
}

} // namespace candela
