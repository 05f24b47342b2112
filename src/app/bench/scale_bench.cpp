#include "app/bench/scale_bench.h"

#include "app/console/picture_output.h"
#include "core/statistics.h"
#include "imaging/compare.h"
#include "session/offline_render.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <omp.h>
#include <sys/resource.h>

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

/// Seconds since the last call, or since it was made.
class Stopwatch {
public:
  double lap() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

private:
  Clock::time_point last_ = Clock::now();
};

std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void count_primitives(const Geometry& geometry, ScaleResult& out) {
  out.distinct_triangles = out.placed_triangles = geometry.world().triangles.size();
  for (const auto& object : geometry.objects()) out.distinct_triangles += object->set.triangles.size();
  for (const Geometry::Placed& placed : geometry.placed())
    out.placed_triangles += geometry.objects()[placed.object]->set.triangles.size();
  out.spheres = geometry.spheres().size();
}

std::size_t accel_bytes(const Geometry& geometry) {
  std::size_t bytes = geometry.accel().memory_bytes();
  for (const auto& object : geometry.objects()) bytes += object->accel.memory_bytes();
  return bytes;
}

int thread_count(int asked) { return asked > 0 ? asked : omp_get_num_procs(); }

void set_size(Document& document, ivec2 size) {
  document.settings.film.width = size.x;
  document.settings.film.height = size.y;
}

/// relMSE of one render, from two renders at an eighth of the size with different seeds: stratified samples
/// have a lower error than their variance predicts.
double pair_relmse(Document document, ivec2 size, const OfflineOptions& options) {
  set_size(document, glm::max(size / 8, ivec2(16)));
  Image images[2];
  for (Image& image : images) {
    ++document.settings.sampler.seed;
    image = render_document(document, options).film.image();
  }
  Image mean = images[0];
  for (std::size_t i = 0; i < mean.pixels.size(); ++i)
    mean.pixels[i] = 0.5f * (mean.pixels[i] + images[1].pixels[i]);
  return 2 * relative_mse(images[0].pixels, mean.pixels); // the mean of two has half the variance of one
}

// The members by name, for writing and reading JSON.
template <class Result, class F>
void for_each_member(Result& r, F f) requires std::same_as<std::remove_const_t<Result>, ScaleResult> {
  f("name", r.name);
  f("distinct_triangles", r.distinct_triangles);
  f("placed_triangles", r.placed_triangles);
  f("spheres", r.spheres);
  f("lights", r.lights);
  f("width", r.width);
  f("height", r.height);
  f("threads", r.threads);
  f("load_s", r.load_s);
  f("build_s", r.build_s);
  f("first_pass_s", r.first_pass_s);
  f("accel_bytes", r.accel_bytes);
  f("scene_bytes", r.scene_bytes);
  f("load_peak_bytes", r.load_peak_bytes);
  f("peak_bytes", r.peak_bytes);
  f("samples_per_s_one_thread", r.samples_per_s_one);
  f("samples_per_s", r.samples_per_s);
  f("speedup", r.speedup);
}

template <class Picture, class F>
void for_each_member(Picture& p, F f) requires std::same_as<std::remove_const_t<Picture>, ScalePicture> {
  f("width", p.width);
  f("height", p.height);
  f("spp", p.spp);
  f("threads", p.threads);
  f("load_s", p.load_s);
  f("build_s", p.build_s);
  f("render_s", p.render_s);
  f("relmse", p.relmse);
  f("variance_relmse", p.variance_relmse);
  f("peak_bytes", p.peak_bytes);
}

template <class T>
std::string json_of(const T& value) {
  nlohmann::ordered_json out;
  for_each_member(value, [&](const char* name, const auto& member) { out[name] = member; });
  return out.dump(2);
}

template <class T>
T from_json(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  T out;
  for_each_member(out, [&](const char* name, auto& member) { json.at(name).get_to(member); });
  return out;
}

} // namespace

ScaleResult measure_scene(const SceneOptions& options, const std::string& name, ivec2 size, int rounds) {
  ScaleResult out;
  out.name = name;
  out.width = size.x;
  out.height = size.y;
  out.threads = thread_count(options.threads);

  Stopwatch watch;
  Document document = load_scene(options).document;
  out.load_s = watch.lap();
  out.load_peak_bytes = peak_bytes();
  set_size(document, size);

  watch.lap();
  const auto scene = RenderScene::build(document);
  out.build_s = watch.lap();
  out.accel_bytes = accel_bytes(scene->geometry());
  out.scene_bytes = scene->memory_bytes();
  count_primitives(scene->geometry(), out);
  out.lights = scene->lights().size();

  watch.lap();
  Film film(size.x, size.y);
  const std::atomic<bool> never{false};
  std::uint32_t sample = 0;
  /// Seconds of one more sample of every pixel.
  auto pass_seconds = [&](int threads) {
    PassOptions pass;
    pass.threads = threads;
    const SampleRange range{sample, sample + 1};
    ++sample;
    render_pass(*scene, document, range, film, never, pass);
    return watch.lap();
  };
  out.first_pass_s = pass_seconds(out.threads);
  out.peak_bytes = peak_bytes();

  std::vector<double> one, all, ratios;
  for (int i = 0; i < rounds; ++i) {
    one.push_back(pass_seconds(1));
    all.push_back(pass_seconds(out.threads));
    ratios.push_back(one.back() / all.back());
  }
  const double samples = static_cast<double>(size.x) * size.y;
  out.samples_per_s_one = samples / percentile(one, 50);
  out.samples_per_s = samples / percentile(all, 50);
  out.speedup = percentile(ratios, 50);
  return out;
}

ScalePicture render_scale_picture(const SceneOptions& options, ivec2 size, int spp, const std::string& path) {
  ScalePicture out;
  out.width = size.x;
  out.height = size.y;
  out.threads = thread_count(options.threads);
  Stopwatch watch;
  Document document = load_scene(options).document;
  out.load_s = watch.lap();
  set_size(document, size);
  document.settings.stop = {spp, 0, 0};
  document.settings.display.denoise = false;
  OfflineOptions offline;
  offline.pass.threads = options.threads;
  const OfflineResult result = render_document(document, offline);
  out.build_s = result.build_seconds;
  out.render_s = result.render_seconds;
  out.spp = result.spp;
  out.variance_relmse = result.noise * result.noise;
  write_picture(result.film.image(), path, document.settings.display, View::radiance, result.display_scale,
                picture_metadata(result.spp, false));
  out.peak_bytes = peak_bytes();
  out.relmse = pair_relmse(document, size, offline);
  return out;
}

std::string to_json(const ScaleResult& result) { return json_of(result); }
std::string to_json(const ScalePicture& picture) { return json_of(picture); }
ScaleResult scale_result(const std::string& json) { return from_json<ScaleResult>(json); }
ScalePicture scale_picture(const std::string& json) { return from_json<ScalePicture>(json); }

} // namespace candela
