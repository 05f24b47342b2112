#pragma once
// Integer hashes for counter-based random numbers: the value depends only on its arguments.

#include <cstdint>

namespace candela {

/// Full-avalanche 32-bit permutation (Ettinger's "triple32" search; Wellons 2018, "Prospecting for Hash
/// Functions").
constexpr std::uint32_t hash32(std::uint32_t x) {
  x ^= x >> 17;
  x *= 0xed5ad4bbu;
  x ^= x >> 11;
  x *= 0xac4c1b51u;
  x ^= x >> 15;
  x *= 0x31848babu;
  x ^= x >> 14;
  return x;
}

/// 64-bit finaliser (Stafford 2011, "Better Bit Mixing", variant 13, as in SplitMix64).
constexpr std::uint64_t hash64(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ull;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebull;
  x ^= x >> 31;
  return x;
}

constexpr std::uint64_t hash_combine(std::uint64_t seed, std::uint64_t value) {
  return hash64(seed * 0x9e3779b97f4a7c15ull + value + 0x9e3779b97f4a7c15ull);
}

/// The top 24 bits as a float in [0, 1): every value is exact, none is 1.
constexpr float to_unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

} // namespace candela
