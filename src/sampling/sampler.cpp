#include "sampling/sampler.h"

#include <algorithm>

namespace candela {

namespace {

/// As many points as are made at once; arrays of them stay in the first-level cache.
constexpr std::size_t kChunk = 64;

/// sobol_point() of many keys and sample numbers. Not inline, and of plain arrays that share no memory, so
/// that compilers vectorise it.
[[gnu::noinline]] void sobol_points(const std::uint32_t* __restrict key_low,
                                    const std::uint32_t* __restrict key_high,
                                    const std::uint32_t* __restrict reversed_sample, std::uint32_t dimension,
                                    std::size_t count, float* __restrict x, float* __restrict y) {
  for (std::size_t i = 0; i < count; ++i) {
    vec2 p = sobol_point((static_cast<std::uint64_t>(key_high[i]) << 32) | key_low[i], reversed_sample[i],
                         dimension);
    x[i] = p.x;
    y[i] = p.y;
  }
}

} // namespace

void Sampler::get_2d(std::span<const Draw> draws, Dimension dimension, std::span<vec2> points) {
  if (draws.empty()) return;
  if (draws[0].sampler->type_ != SamplerType::sobol) {
    for (std::size_t i = 0; i < draws.size(); ++i)
      points[i] = draws[i].sampler->get_2d(dimension, draws[i].index);
    return;
  }
  std::array<std::uint32_t, kChunk> low, high, reversed;
  std::array<float, kChunk> x, y;
  for (std::size_t begin = 0; begin < draws.size(); begin += kChunk) {
    const std::size_t count = std::min(kChunk, draws.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Draw& draw = draws[begin + i];
      std::uint64_t key = draw.sampler->sobol_key(draw.index);
      low[i] = low_bits(key), high[i] = high_bits(key);
      reversed[i] = draw.sampler->reversed_sample_;
    }
    sobol_points(low.data(), high.data(), reversed.data(), static_cast<std::uint32_t>(dimension), count,
                 x.data(), y.data());
    for (std::size_t i = 0; i < count; ++i) points[begin + i] = {x[i], y[i]};
  }
}

void Sampler::get_1d(std::span<const Draw> draws, Dimension dimension, std::span<float> points) {
  if (draws.empty()) return;
  if (draws[0].sampler->type_ != SamplerType::sobol) {
    for (std::size_t i = 0; i < draws.size(); ++i)
      points[i] = draws[i].sampler->get_1d(dimension, draws[i].index);
    return;
  }
  std::array<vec2, kChunk> both;
  for (std::size_t begin = 0; begin < draws.size(); begin += kChunk) {
    const std::size_t count = std::min(kChunk, draws.size() - begin);
    get_2d(draws.subspan(begin, count), dimension, both);
    for (std::size_t i = 0; i < count; ++i) points[begin + i] = both[i].x;
  }
}

} // namespace candela
