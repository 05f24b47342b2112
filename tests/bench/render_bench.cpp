// Samples per second on the Cornell box (512x512, box filter, unlimited depth, default settings), and the
// noise: relMSE x spp and the efficiency 1 / (relMSE x seconds), from pairs of independent seeds. Or on
// another scene of versus_cycles.
//
//   render_bench [--short] [--scene cornell|ball|plates] [--size N] [--threads N] [KEY=VALUE ...]

#include "core/error.h"
#include "session/offline_render.h"
#include "versus_cycles/measure.h"
#include "versus_cycles/scenes.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <omp.h>

using namespace candela;

namespace {

versus::VersusScene make_scene(const std::string& name, int size, bool short_run) {
  if (name == "cornell") return versus::cornell_box(size);
  if (name == "ball") return versus::bumpy_ball(size, short_run ? 4 : 8);
  if (name == "plates") return versus::veach_plates(size);
  throw usage_error("--scene " + name, "there is no such scene", "cornell, ball or plates");
}

int run(int argc, char** argv) {
  int size = 512, repeats = 3;
  bool short_run = false;
  std::string name = "cornell";
  OfflineOptions options;
  std::vector<std::string> settings;
  for (int i = 1; i < argc; ++i) {
    bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "--short") == 0)
      short_run = true, size = 128, repeats = 1;
    else if (std::strcmp(argv[i], "--threads") == 0 && more)
      options.pass.threads = std::atoi(argv[++i]);
    else if (std::strcmp(argv[i], "--scene") == 0 && more)
      name = argv[++i];
    else if (std::strcmp(argv[i], "--size") == 0 && more)
      size = std::atoi(argv[++i]);
    else
      settings.emplace_back(argv[i]);
  }
  Document document = make_scene(name, size, short_run).document;
  document.settings.stop.spp = short_run ? 4 : 64;
  for (const std::string& s : settings) apply_setting(document, s);
  const int spp = document.settings.stop.spp;

  double best = 0, seconds = 0;
  std::vector<Image> images;
  RayCounts rays;
  for (int i = 0; i < 2 * repeats; ++i) {
    document.settings.sampler.seed = i;
    OfflineResult r = render_document(document, options);
    rays = r.rays;
    seconds = best == 0 ? r.render_seconds : std::min(seconds, r.render_seconds);
    best = std::max(best, static_cast<double>(r.rays.samples) / r.render_seconds);
    images.push_back(r.film.image());
  }
  double relmse = versus::noise_relative_mse(images, versus::mean_of(images));
  double n = static_cast<double>(rays.samples);
  fmt::print("{}, {}x{}, {} spp, {} threads\n", name, size, size, spp,
             options.pass.threads > 0 ? options.pass.threads : omp_get_num_procs());
  fmt::print("  {:.3f} Msamples/s (best of {}), {:.2f} closest-hit and {:.2f} shadow rays a sample\n",
             best / 1e6, 2 * repeats, static_cast<double>(rays.closest) / n,
             static_cast<double>(rays.shadow) / n);
  fmt::print("  relMSE x spp {:.4f}, efficiency {:.1f}\n", relmse * spp, 1 / (relmse * seconds));
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& e) {
    fmt::print(stderr, "render_bench: {}\n", e.what());
    return static_cast<int>(e.code());
  }
}
