#pragma once
// Shared by the tests of samplers.

#include "sampling/sampler.h"

#include <vector>

namespace candela::test {

inline constexpr SamplerType kSamplerTypes[] = {
    SamplerType::independent, SamplerType::stratified, SamplerType::halton,    SamplerType::sobol,
    SamplerType::pmj02,       SamplerType::lattice,    SamplerType::blue_noise};
inline constexpr int kSamplerTypeCount = static_cast<int>(std::size(kSamplerTypes));
inline constexpr SamplerType kNetSamplers[] = {SamplerType::sobol, SamplerType::pmj02,
                                               SamplerType::blue_noise};

inline constexpr auto kDimensions = static_cast<std::uint32_t>(Dimension::count);
inline Dimension dimension(std::uint32_t i) { return static_cast<Dimension>(i); }

/// All that one number depends on, but for the seed.
struct Key {
  uvec2 pixel;
  std::uint32_t sample, bounce;
  Dimension dimension;
  std::uint32_t index;
};

inline vec2 draw(Sampler& sampler, const Key& k) {
  sampler.start(k.pixel, k.sample);
  sampler.set_bounce(k.bounce);
  return sampler.get_2d(k.dimension, k.index);
}

/// Pixels whose numbers are independent with every sampler: those of blue_noise are only in different tiles.
inline uvec2 independent_pixel(SamplerType type, std::uint32_t x, std::uint32_t y) {
  if (type != SamplerType::blue_noise) return {x, y};
  std::uint32_t h = hash32(x * 0x10001u ^ hash32(y));
  return {x * kBlueNoiseTile + h % kBlueNoiseTile, y * kBlueNoiseTile + (h >> 16) % kBlueNoiseTile};
}

/// Whether the 2^m points have one in each elementary interval of size 2^-m, of every shape.
inline bool is_net(const std::vector<vec2>& points, int m) {
  for (int x_bits = 0; x_bits <= m; ++x_bits) {
    std::vector<bool> taken(points.size());
    for (vec2 p : points) {
      auto x = static_cast<std::size_t>(std::ldexp(p.x, x_bits)),
           y = static_cast<std::size_t>(std::ldexp(p.y, m - x_bits));
      std::size_t interval = (x << (m - x_bits)) | y;
      if (taken[interval]) return false;
      taken[interval] = true;
    }
  }
  return true;
}

} // namespace candela::test
