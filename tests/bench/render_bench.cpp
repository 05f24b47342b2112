// Samples per second on the Cornell box (512x512, box filter, unlimited depth, default settings), and the
// noise that they leave: relMSE x spp and the efficiency 1 / (relMSE x seconds), from pairs of independent
// seeds.
//
//   render_bench [--short] [--threads N] [KEY=VALUE ...]

#include "session/offline_render.h"
#include "support/scenes.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <omp.h>

using namespace candela;

namespace {

/// relMSE of one render, from two that differ in their seed only: half the mean squared difference, relative
/// to the square of the mean of both. Bias would not show; the tests look for that.
double relative_mse(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      double x = static_cast<double>(a.pixels[i][c]), y = static_cast<double>(b.pixels[i][c]),
             r = 0.5 * (x + y);
      sum += 0.5 * (x - y) * (x - y) / (r * r + 0.01);
    }
  return sum / (3 * static_cast<double>(a.pixels.size()));
}

} // namespace

int main(int argc, char** argv) {
  int size = 512, spp = 64, repeats = 3;
  OfflineOptions options;
  std::vector<std::string> settings;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--short") == 0)
      size = 128, spp = 4, repeats = 1;
    else if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc)
      options.pass.threads = std::atoi(argv[++i]);
    else
      settings.emplace_back(argv[i]);
  }
  test::SceneMaker scene = test::cornell_flush(size, size, spp, true);
  for (const std::string& s : settings) apply_setting(scene.document, s);

  double best = 0, seconds = 0;
  std::vector<Image> images;
  RayCounts rays;
  for (int i = 0; i < 2 * repeats; ++i) {
    scene.document.settings.sampler.seed = i;
    OfflineResult r = render_document(scene.document, options);
    rays = r.rays;
    seconds = best == 0 ? r.render_seconds : std::min(seconds, r.render_seconds);
    best = std::max(best, static_cast<double>(r.rays.samples) / r.render_seconds);
    images.push_back(r.film.image());
  }
  double relmse = 0;
  for (int i = 0; i < repeats; ++i)
    relmse +=
        relative_mse(images[2 * static_cast<std::size_t>(i)], images[2 * static_cast<std::size_t>(i) + 1]) /
        repeats;
  double n = static_cast<double>(rays.samples);
  fmt::print("Cornell box, {}x{}, {} spp, {} threads\n", size, size, spp,
             options.pass.threads > 0 ? options.pass.threads : omp_get_num_procs());
  fmt::print("  {:.3f} Msamples/s (best of {}), {:.2f} closest-hit and {:.2f} shadow rays a sample\n",
             best / 1e6, 2 * repeats, static_cast<double>(rays.closest) / n,
             static_cast<double>(rays.shadow) / n);
  fmt::print("  relMSE x spp {:.4f}, efficiency {:.1f}\n", relmse * spp, 1 / (relmse * seconds));
  return 0;
}
