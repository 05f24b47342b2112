// The same scenes in Candela and in Blender's Cycles on the CPU: speed and noise of both, and whether they
// have the same expectation.
//
//   versus_cycles_bench [--short] [--scene NAME] [--size N] [--spp N]
//   [--seeds N]
//                       [--threads N] [--keep FOLDER] [--cycles NAME=VALUE] [KEY=VALUE ...]
//
// Both get box filter, unlimited depth, no clamping, no adaptive sampling, no denoiser, the same samples and
// as many threads; the renders alternate, so that disturbances affect both. Seconds are for rendering only,
// the least of all seeds; relMSE comes from pairs of seeds, relative to the same image (the mean of all
// renders of both); eff = 1 / (relMSE x seconds). --short is for tests: small pictures and few samples,
// without meaningful times. --keep keeps the pictures, blender's output and the scene (candela.json).
// Exits with 1 if the means differ by more than noise and tolerances allow.

#include "core/error.h"
#include "imaging/display_transform.h"
#include "io/images/image_file.h"
#include "io/scene_export.h"
#include "session/offline_render.h"
#include "support/scratch_folder.h"
#include "versus_cycles/cycles.h"
#include "versus_cycles/measure.h"
#include "versus_cycles/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

using namespace candela;
using namespace candela::versus;

namespace {

struct Options {
  bool short_run = false;
  int size = 512, spp = 0, seeds = 4, threads = 2; ///< spp 0: each scene's own
  std::string scene, keep;
  std::vector<std::string> settings, cycles_settings;
};

struct Renders {
  std::vector<Image> images;
  std::vector<double> seconds;
};

Options read_options(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    auto value = [&]() -> std::string {
      if (i + 1 == argc) throw usage_error(word, "it has no value", "give one");
      return argv[++i];
    };
    auto number = [&] {
      int n = std::atoi(value().c_str());
      if (n < 1) throw usage_error(word, "it is no positive number", "give one");
      return n;
    };
    if (word == "--short")
      o.short_run = true, o.size = 64, o.spp = 64, o.seeds = 2;
    else if (word == "--scene")
      o.scene = value();
    else if (word == "--size")
      o.size = number();
    else if (word == "--spp")
      o.spp = number();
    else if (word == "--seeds")
      o.seeds = (number() + 1) / 2 * 2; // pairs
    else if (word == "--threads")
      o.threads = number();
    else if (word == "--keep")
      o.keep = value();
    else if (word == "--cycles")
      o.cycles_settings.push_back(value());
    else if (word.starts_with("--"))
      throw usage_error(word, "there is no such option",
                        "see the head of tests/bench/versus_cycles/main.cpp");
    else
      o.settings.push_back(word);
  }
  return o;
}

struct Row {
  double seconds, spread, msamples, relmse, efficiency;
};

Row measure(const Renders& r, const Image& reference, int spp) {
  auto [least, most] = std::minmax_element(r.seconds.begin(), r.seconds.end());
  double relmse = noise_relative_mse(r.images, reference);
  return {*least, *most / *least - 1, spp * static_cast<double>(reference.pixels.size()) / *least / 1e6,
          relmse, 1 / (relmse * *least)};
}

void print_row(std::string_view name, const Row& r, int spp) {
  fmt::print("  {:<18} {:>8.2f} {:>+8.0f} % {:>12.3f} {:>12.3e} {:>14.4f} {:>11.2f}\n", name, r.seconds,
             100 * r.spread, r.msamples, r.relmse, r.relmse * spp, r.efficiency);
}

std::string to_text(const MeanRatio& r) { return fmt::format("{:.4f} +- {:.4f}", r.value, r.standard_error); }

void print_means(const MeansReport& means) {
  fmt::print("  means, Candela / Cycles: {}\n    red {}, green {}, blue {}; the worst of 8 x 8 blocks {}\n",
             means.disagreements.empty() ? "they agree" : "THEY DISAGREE", to_text(means.image[0]),
             to_text(means.image[1]), to_text(means.image[2]), to_text(means.worst_block));
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(means.disagreements.size(), kShown); ++i)
    fmt::print("    {}\n", means.disagreements[i]);
  if (means.disagreements.size() > kShown)
    fmt::print("    and {} more\n", means.disagreements.size() - kShown);
}

void write_png(const Image& image, const DisplayTransform& transform, const std::string& path) {
  std::vector<std::uint8_t> rgb(3 * image.pixels.size());
  display_rgb8(image.pixels, {image.width}, transform, rgb);
  write_srgb8_image(image.width, image.height, rgb, path);
}

/// Whether the means agree.
bool compare(VersusScene scene, const std::string& blender, const std::string& folder, const Options& o) {
  for (const std::string& s : o.settings) apply_setting(scene.document, s);
  int spp = o.spp > 0 ? o.spp : scene.spp;
  scene.document.settings.stop.spp = spp;
  std::filesystem::create_directories(folder);
  write_cycles_scene(scene.document, folder);
  if (!o.keep.empty()) export_candela_json(scene.document, folder + "/candela.json");
  Cycles cycles(blender, folder, o.threads, o.cycles_settings);
  OfflineOptions options;
  options.pass.threads = o.threads;
  Renders candela_renders, cycles_renders;
  for (int seed = 0; seed < o.seeds; ++seed) {
    scene.document.settings.sampler.seed = seed;
    OfflineResult r = render_document(scene.document, options);
    candela_renders.images.push_back(r.film.image());
    candela_renders.seconds.push_back(r.render_seconds);
    std::string exr = fmt::format("{}/cycles_{}.exr", folder, seed);
    cycles_renders.seconds.push_back(cycles.render(seed, spp, exr));
    cycles_renders.images.push_back(read_image(exr));
    write_linear_image(candela_renders.images.back(), fmt::format("{}/candela_{}.exr", folder, seed));
  }
  Image a = mean_of(candela_renders.images), b = mean_of(cycles_renders.images), reference = mean_of({a, b});
  fmt::print("{} ({}), {} spp\n", scene.name, scene.description, spp);
  fmt::print("  {:<18} {:>8} {:>10} {:>12} {:>12} {:>14} {:>11}\n", "", "seconds", "slowest", "Msamples/s",
             "relMSE", "relMSE x spp", "eff");
  Row x = measure(candela_renders, reference, spp), y = measure(cycles_renders, reference, spp);
  print_row("Candela", x, spp);
  print_row("Cycles " + cycles.version(), y, spp);
  fmt::print("  {:<18} {:>8.2f} {:>10} {:>12.2f} {:>12.2f} {:>14} {:>11.2f}\n", "Candela / Cycles",
             x.seconds / y.seconds, "", x.msamples / y.msamples, x.relmse / y.relmse, "",
             x.efficiency / y.efficiency);
  MeansReport means = compare_means(candela_renders.images, cycles_renders.images, scene.image_tolerance,
                                    scene.block_tolerance);
  print_means(means);
  std::fflush(stdout);
  if (!o.keep.empty()) {
    DisplayTransform transform =
        display_transform(a.pixels, a.width, a.height, scene.document.settings.display, View::radiance, 1);
    write_png(a, transform, folder + "/candela.png");
    write_png(b, transform, folder + "/cycles.png");
  }
  return means.disagreements.empty();
}

int run(const Options& o) {
  auto blender = find_blender();
  if (!blender) {
    fmt::print("skipped: blender was not found\n");
    return 0;
  }
  test::ScratchFolder scratch;
  const std::string& folder = o.keep.empty() ? scratch.path() : o.keep;
  double load = 0;
  ::getloadavg(&load, 1);
  fmt::print("{0}x{0}, {1} threads, {2} seeds; load average before: {3:.2f}\n", o.size, o.threads, o.seeds,
             load);
  bool agree = true, any = false;
  auto run_scene = [&](const std::string& name, auto&& make) {
    if (!o.scene.empty() && o.scene != name) return;
    any = true;
    agree &= compare(make(), *blender, folder + "/" + name, o);
  };
  run_scene("cornell", [&] { return cornell_box(o.size); });
  run_scene("ball", [&] { return bumpy_ball(o.size, o.short_run ? 4 : 8); });
  run_scene("plates", [&] { return veach_plates(o.size); });
  run_scene("glass", [&] { return rough_glass(o.size); });
  run_scene("principled", [&] { return principled_balls(o.size); });
  run_scene("fog", [&] { return foggy_spot(o.size); });
  run_scene("smoke", [&] { return smoke_ball(o.size); });
  run_scene("hair", [&] { return furry_ball(o.size, o.short_run ? 500 : 10000); });
  if (!any)
    throw usage_error("--scene " + o.scene, "there is no such scene",
                      "cornell, ball, plates, glass, principled, fog, smoke or hair");
  return agree ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(read_options(argc, argv));
  } catch (const Error& e) {
    fmt::print(stderr, "versus_cycles: {}\n", e.what());
    return static_cast<int>(e.code());
  }
}
