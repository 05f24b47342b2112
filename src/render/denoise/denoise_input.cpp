#include "render/denoise/denoise_input.h"

#include <memory>

namespace candela::denoising {

namespace {

/// Standard deviation, relative to the pixel, below which a difference of colours is no difference. Keeps
/// distances finite where nothing is noisy.
constexpr float kColorFloor = 1e-3f;
/// The same of features, absolute: they are of size 1.
constexpr float kFeatureFloor = 3e-3f;
constexpr float kSmallest = 1e-12f;

constexpr int kFeatureRadius = 5; ///< of the window that is searched for similar features
constexpr float kFeatureK = 1;    ///< how much unlike they may be

Planes planes_of(const Image& image) {
  Planes planes(image.width, image.height, 3);
  const std::size_t n = planes.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      planes.values[c * n + i] = image.pixels[i][static_cast<glm::length_t>(c)];
  return planes;
}

/// Mean over (2 radius + 1)^2 pixels, fewer at the border.
Planes box_filtered(const Planes& in, int radius) {
  Planes rows(in.width, in.height, 3), out(in.width, in.height, 3);
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < in.height; ++y) {
      const float* from = in.row(c, y);
      float* to = rows.row(c, y);
      for (int x = 0; x < in.width; ++x) {
        int lo = std::max(x - radius, 0), hi = std::min(x + radius, in.width - 1);
        float sum = 0;
        for (int k = lo; k <= hi; ++k) sum += from[k];
        to[x] = sum / static_cast<float>(hi - lo + 1);
      }
    }
    for (int y = 0; y < in.height; ++y) {
      int lo = std::max(y - radius, 0), hi = std::min(y + radius, in.height - 1);
      float* to = out.row(c, y);
      for (int k = lo; k <= hi; ++k) {
        const float* from = rows.row(c, k);
        for (int x = 0; x < in.width; ++x) to[x] += from[x];
      }
      for (int x = 0; x < in.width; ++x) to[x] /= static_cast<float>(hi - lo + 1);
    }
  }
  return out;
}

bool is_sound(const NoisyImage& image, std::size_t i) {
  return is_finite(image.half[0].pixels[i]) && is_finite(image.half[1].pixels[i]) &&
         is_finite(image.variance.pixels[i]);
}

/// The pixel's substitute: the mean over the sound ones of the smallest square about it that has any.
void repair(const NoisyImage& image, int x, int y, Halves& out) {
  const int width = image.variance.width, height = image.variance.height;
  const std::size_t n = out.variance.size();
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  vec3 sum[2] = {vec3(0), vec3(0)};
  float count = 0;
  for (int radius = 1; count == 0 && radius <= 8; ++radius)
    for (int qy = std::max(y - radius, 0); qy <= std::min(y + radius, height - 1); ++qy)
      for (int qx = std::max(x - radius, 0); qx <= std::min(x + radius, width - 1); ++qx) {
        std::size_t q =
            static_cast<std::size_t>(qy) * static_cast<std::size_t>(width) + static_cast<std::size_t>(qx);
        if (!is_sound(image, q)) continue;
        sum[0] += image.half[0].pixels[q];
        sum[1] += image.half[1].pixels[q];
        ++count;
      }
  for (std::size_t c = 0; c < 3; ++c) {
    float mean = 0;
    for (int h = 0; h < 2; ++h) {
      float value = count > 0 ? sum[h][static_cast<glm::length_t>(c)] / count : 0;
      out.mean[h].values[c * n + i] = value;
      mean += 0.5f * value;
    }
    out.variance.values[c * n + i] = mean * mean; // nothing is known of it but what is around it
  }
}

/// How much larger than the mean of `variance` around it the mean square of the halves' difference is.
std::vector<float> variance_scale(const Halves& h, const Planes& smooth) {
  const std::size_t n = smooth.size();
  Planes measured(smooth.width, smooth.height, 3), told = measured;
  for (std::size_t i = 0; i < n; ++i) {
    // Relative to the pixel's level, so that one bright pixel does not dominate its neighbourhood.
    float unit = 1 / (smooth.values[i] + smooth.values[n + i] + smooth.values[2 * n + i] + kSmallest);
    for (std::size_t k = i; k < 3 * n; k += n) {
      measured.values[k] = 0.25f * unit * sqr(h.mean[0].values[k] - h.mean[1].values[k]);
      told.values[k] = unit * h.variance.values[k];
    }
  }
  constexpr int kRadius = 10; // many pixels, for each difference is one chi-square number
  measured = box_filtered(measured, kRadius);
  told = box_filtered(told, kRadius);
  std::vector<float> scale(n, 1.0f);
  for (std::size_t i = 0; i < n; ++i) {
    float sum = told.values[i] + told.values[n + i] + told.values[2 * n + i];
    if (sum > 0)
      scale[i] = std::clamp((measured.values[i] + measured.values[n + i] + measured.values[2 * n + i]) / sum,
                            0.1f, 1.5f);
  }
  return scale;
}

/// The variance of the mean becomes that of either half, and never 0.
float half_variance(float variance_of_mean, float floor) {
  return 2 * variance_of_mean + floor * floor + kSmallest;
}

} // namespace

Halves prepare_color(const NoisyImage& color) {
  Halves h{{planes_of(color.half[0]), planes_of(color.half[1])}, planes_of(color.variance)};
  for (int y = 0; y < h.variance.height; ++y)
    for (int x = 0; x < h.variance.width; ++x)
      if (!is_sound(color, static_cast<std::size_t>(y) * static_cast<std::size_t>(h.variance.width) +
                               static_cast<std::size_t>(x)))
        repair(color, x, y, h);
  Planes smooth = box_filtered(h.variance, 1);
  std::vector<float> scale = variance_scale(h, smooth);
  const std::size_t n = smooth.size();
  for (std::size_t k = 0; k < 3 * n; ++k) {
    float mean = 0.5f * (h.mean[0].values[k] + h.mean[1].values[k]);
    h.variance.values[k] = half_variance(scale[k % n] * smooth.values[k], kColorFloor * mean);
  }
  return h;
}

void prepare_feature(const NoisyImage& feature, Planes& out, int first_channel, int threads,
                     const std::atomic<bool>& stop) {
  Halves h{{planes_of(feature.half[0]), planes_of(feature.half[1])}, planes_of(feature.variance)};
  for (float& v : h.variance.values) v = half_variance(v, kFeatureFloor);
  const int width = out.width, height = out.height;
  const TileGrid tiles(width, height);
  using Distances = PatchDistances<kFeatureRadius, DistanceUnit::own>;
#pragma omp parallel num_threads(threads)
  {
    auto distances = std::make_unique<Distances>();
    Distances::Tile weight;
#pragma omp for schedule(dynamic, 1)
    for (int t = 0; t < tiles.count(); ++t) {
      if (stop.load(std::memory_order_relaxed)) continue;
      const ivec2 origin = tiles.origin(t);
      const int rows = std::min(kTileHeight, height - origin.y);
      const int columns = std::min(kTileWidth, width - origin.x);
      for (int half = 0; half < 2; ++half) {
        const Planes& other = h.mean[1 - half];
        distances->load(h.mean[half], h.variance, origin);
        float sum[4][kTileHeight][kTileWidth] = {}; // three channels and the weights
        for (int dy = -kFeatureRadius; dy <= kFeatureRadius; ++dy)
          for (int dx = -kFeatureRadius; dx <= kFeatureRadius; ++dx) {
            distances->weights(dx, dy, kFeatureK, weight);
            const int first = std::max(0, -(origin.x + dx));
            const int last = std::min(columns, width - (origin.x + dx));
            for (int y = std::max(0, -(origin.y + dy)); y < std::min(rows, height - (origin.y + dy)); ++y) {
              for (int c = 0; c < 3; ++c) {
                const float* q = other.row(c, origin.y + y + dy) + origin.x + dx;
                for (int x = first; x < last; ++x) sum[c][y][x] += weight[y][x] * q[x];
              }
              for (int x = first; x < last; ++x) sum[3][y][x] += weight[y][x];
            }
          }
        for (int c = 0; c < 3; ++c)
          for (int y = 0; y < rows; ++y) {
            float* to = out.row(first_channel + c, origin.y + y) + origin.x;
            for (int x = 0; x < columns; ++x) to[x] += 0.5f * sum[c][y][x] / sum[3][y][x];
          }
      }
    }
  }
}

} // namespace candela::denoising
