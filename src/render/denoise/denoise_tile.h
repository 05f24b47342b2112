#pragma once
// Non-local means weights between the pixels of a tile and their neighbours, for the denoiser's passes. All
// loops run along rows of fixed length over planes of floats, so that the compiler makes vectors of them.

#include "imaging/image.h"

#include <utility>

namespace candela::denoising {

/// One float a pixel and channel, channel after channel.
struct Planes {
  int width = 0, height = 0;
  std::vector<float> values;

  Planes() = default;
  Planes(int w, int h, int channels)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) *
                                    static_cast<std::size_t>(channels)) {}
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  float* row(int channel, int y) { return const_cast<float*>(std::as_const(*this).row(channel, y)); }
  const float* row(int channel, int y) const {
    return values.data() + static_cast<std::size_t>(channel) * size() +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

/// An image of three channels in two halves, and the variance of either.
struct Halves {
  Planes mean[2];
  Planes variance;
};

inline constexpr int kTileWidth = 64, kTileHeight = 16;
/// Radius of the patches that are compared: 7x7 pixels, as in the papers.
inline constexpr int kPatch = 3;

struct TileGrid {
  int columns, rows;
  TileGrid(int width, int height)
      : columns((width + kTileWidth - 1) / kTileWidth), rows((height + kTileHeight - 1) / kTileHeight) {}
  int count() const { return columns * rows; }
  ivec2 origin(int tile) const { return {tile % columns * kTileWidth, tile / columns * kTileHeight}; }
};

/// e^-x for x >= 0, to a few percent and exactly 0 from 16 on, which is enough for a weight; made of
/// multiplications.
inline float falloff(float x) {
  float b = std::max(1 - x * (1 / 16.0f), 0.0f);
  b *= b, b *= b, b *= b;
  return b * b;
}

/// What the squared difference of two pixels is measured by.
enum class DistanceUnit {
  both, ///< the variances of both: colours, which are noisy everywhere
  own,  ///< that of the pixel which is to be filtered: one without noise is left as it is
};

/// How the patches about a tile's pixels differ from those at an offset of up to `Radius` on either axis.
template <int Radius, DistanceUnit Unit>
class PatchDistances {
public:
  using Tile = float[kTileHeight][kTileWidth];

  /// Copies the tile whose top left pixel is `origin` and what is around it; beyond the border the nearest
  /// pixel is repeated.
  void load(const Planes& mean, const Planes& variance, ivec2 origin) {
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y) {
        int from_y = std::clamp(origin.y + y - kPad, 0, mean.height - 1);
        const float* m = mean.row(c, from_y);
        const float* v = variance.row(c, from_y);
        for (int x = 0; x < kWidth; ++x) {
          int from_x = std::clamp(origin.x + x - kPad, 0, mean.width - 1);
          mean_[c][y][x] = m[from_x];
          variance_[c][y][x] = v[from_x];
        }
      }
  }

  /// exp(-d / k^2), d being the mean over the patch of the squared difference beyond what the variances
  /// explain, in units of them (Rousselle et al. 2012, "Adaptive Rendering with Non-local Means Filtering",
  /// eq. 5 and 6; numerator and denominator are summed over the channels first).
  void weights(int dx, int dy, float k, Tile& out) {
    constexpr int w = kTileWidth + 2 * kPatch, h = kTileHeight + 2 * kPatch;
    for (int y = 0; y < h; ++y) {
      float difference[w] = {}, unit[w] = {};
      for (int c = 0; c < 3; ++c) {
        const float* p = &mean_[c][y + Radius][Radius];
        const float* p_variance = &variance_[c][y + Radius][Radius];
        const float* q = &mean_[c][y + Radius + dy][Radius + dx];
        const float* q_variance = &variance_[c][y + Radius + dy][Radius + dx];
        for (int x = 0; x < w; ++x) {
          float d = p[x] - q[x];
          difference[x] += d * d - (p_variance[x] + std::min(p_variance[x], q_variance[x]));
          unit[x] += p_variance[x] + (Unit == DistanceUnit::both ? q_variance[x] : p_variance[x]);
        }
      }
      for (int x = 0; x < w; ++x) distance_[y][x] = difference[x] / unit[x];
    }
    constexpr int kPatchPixels = (2 * kPatch + 1) * (2 * kPatch + 1);
    const float scale = 1 / (k * k * static_cast<float>(kPatchPixels));
    for (int y = 0; y < kTileHeight; ++y) {
      float column[w] = {}, sum[kTileWidth] = {};
      for (int i = 0; i <= 2 * kPatch; ++i)
        for (int x = 0; x < w; ++x) column[x] += distance_[y + i][x];
      for (int i = 0; i <= 2 * kPatch; ++i)
        for (int x = 0; x < kTileWidth; ++x) sum[x] += column[x + i];
      for (int x = 0; x < kTileWidth; ++x) out[y][x] = falloff(std::max(sum[x] * scale, 0.0f));
    }
  }

private:
  static constexpr int kPad = Radius + kPatch;
  static constexpr int kWidth = kTileWidth + 2 * kPad, kHeight = kTileHeight + 2 * kPad;

  float mean_[3][kHeight][kWidth];
  float variance_[3][kHeight][kWidth];
  float distance_[kTileHeight + 2 * kPatch][kTileWidth + 2 * kPatch];
};

} // namespace candela::denoising
