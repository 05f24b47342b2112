#include "render/denoise/denoiser.h"

#include "render/denoise/denoise_input.h"
#include "render/denoise/denoise_regression.h"

#include <memory>
#include <omp.h>

namespace candela {

using namespace denoising;

namespace {

/// Tiles that are so many apart write to no pixel in common: they may run at once, and as those of one phase
/// follow those of the last, every pixel's sum has one order for any number of threads.
constexpr int kColumnPhases = 2, kRowPhases = 3;
static_assert(kTileWidth * (kColumnPhases - 1) >= 2 * kWindow &&
              kTileHeight * (kRowPhases - 1) >= 2 * kWindow);

void regress(const Halves& color, int guide, const Planes& features, Planes& out, int threads,
             const std::atomic<bool>& stop) {
  const TileGrid tiles(out.width, out.height);
#pragma omp parallel num_threads(threads)
  {
    auto regression = std::make_unique<TileRegression>();
    for (int phase = 0; phase < kColumnPhases * kRowPhases; ++phase) {
      const int first_column = phase % kColumnPhases, first_row = phase / kColumnPhases;
      const int columns = (tiles.columns - first_column + kColumnPhases - 1) / kColumnPhases;
      const int rows = (tiles.rows - first_row + kRowPhases - 1) / kRowPhases;
#pragma omp for schedule(dynamic, 1) // and all wait for the last, before the next phase
      for (int t = 0; t < columns * rows; ++t) {
        if (stop.load(std::memory_order_relaxed)) continue;
        const ivec2 origin((first_column + t % columns * kColumnPhases) * kTileWidth,
                           (first_row + t / columns * kRowPhases) * kTileHeight);
        regression->run(color.mean[guide], color.variance, color.mean[1 - guide], features, origin, out);
      }
    }
  }
}

} // namespace

std::optional<Image> denoise(const DenoiseInput& input, const DenoiseOptions& options) {
  static const std::atomic<bool> kNeverStop{false};
  const std::atomic<bool>& stop = options.stop ? *options.stop : kNeverStop;
  const int threads = options.threads > 0 ? options.threads : omp_get_num_procs();
  const int width = input.color.variance.width, height = input.color.variance.height;

  const Halves color = prepare_color(input.color);
  Planes features(width, height, kFeatures);
  const NoisyImage* images[] = {&input.albedo, &input.normal, &input.position};
  for (int i = 0; i < 3; ++i) prepare_feature(*images[i], features, 3 * i, threads, stop);

  Image result{width, height, std::vector<vec3>(color.variance.size())};
  for (int guide = 0; guide < 2; ++guide) {
    Planes sums(width, height, 4);
    regress(color, guide, features, sums, threads, stop);
    if (stop) return std::nullopt;
    const std::size_t n = sums.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c) // a pixel is always like itself, so there is a weight
        result.pixels[i][static_cast<glm::length_t>(c)] +=
            0.5f * sums.values[c * n + i] / sums.values[3 * n + i];
  }
  // A line fitted to what is not negative may dip below 0 all the same.
  for (vec3& pixel : result.pixels) pixel = glm::max(pixel, 0.0f);
  return result;
}

} // namespace candela
