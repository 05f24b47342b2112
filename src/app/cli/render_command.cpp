#include "app/cli/render_command.h"

#include "app/console/aov_output.h"
#include "app/console/denoised_picture.h"
#include "app/console/outputs.h"
#include "app/console/picture_output.h"
#include "app/console/progress_bar.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "core/progress.h"
#include "imaging/compare.h"
#include "io/files/atomic_file.h"
#include "io/images/image_file.h"
#include "render/denoise/denoise_film.h"
#include "render/film/film_view.h"
#include "session/offline_render.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>

namespace candela {

namespace {

std::atomic<bool> stop_requested{false};
volatile std::sig_atomic_t stop_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// The second signal ends the process at once, even while files are written.
extern "C" void on_signal(int signal) {
  if (stop_requested) _exit(128 + signal);
  stop_signal = signal;
  stop_requested = true;
}

int interrupted_status() {
  return stop_signal == SIGTERM ? static_cast<int>(ExitCode::terminated)
                                : static_cast<int>(ExitCode::interrupted);
}

/// While this exists, SIGINT and SIGTERM end the render early. (While a scene is read, they end the process.)
class SignalGuard {
public:
  SignalGuard() {
    stop_requested = false; // of an earlier render
    interrupt_ = std::signal(SIGINT, on_signal);
    terminate_ = std::signal(SIGTERM, on_signal);
  }
  ~SignalGuard() {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, terminate_);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
};

void apply_options(const RenderOptions& o, Document& document, PassOptions& pass) {
  if (o.spp) document.settings.stop.spp = *o.spp;
  if (o.time) document.settings.stop.time = *o.time;
  if (o.noise) document.settings.stop.noise = *o.noise;
  if ((o.time || o.noise) && !o.spp) document.settings.stop.spp = 0; // only these criteria apply
  if (o.seed) document.settings.sampler.seed = *o.seed;
  if (o.size) {
    auto size = integers(*o.size, 'x', 2, "--size", "WxH, such as 1280x720");
    document.settings.film.width = size[0];
    document.settings.film.height = size[1];
  }
  // Options are settings too, and --set overrides both file and job.
  for (const std::string& s : o.scene.settings) apply_setting(document, s);
  if (auto problem = document_problem(document); !problem.empty())
    throw usage_error("settings", problem, "see `candela settings`");
  pass.threads = o.scene.threads;
  if (o.crop) {
    auto c = integers(*o.crop, ',', 4, "--crop", "X,Y,W,H in pixels");
    const FilmSettings& film = document.settings.film;
    if (c[0] < 0 || c[1] < 0 || c[2] < 1 || c[3] < 1 || c[2] > film.width - c[0] || c[3] > film.height - c[1])
      throw usage_error(fmt::format("--crop {}", *o.crop), "the window is not inside the film",
                        fmt::format("stay within {}x{}", film.width, film.height));
    pass.crop = {c[0], c[1], c[2], c[3]};
  }
}

nlohmann::ordered_json stats_json(const Document& document, const OfflineResult& result, const Image& image,
                                  double load_seconds, std::optional<double> denoise_seconds, int threads) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  nlohmann::ordered_json j;
  j["version"] = CANDELA_VERSION;
  j["load_s"] = load_seconds;
  j["build_s"] = result.build_seconds;
  j["render_s"] = result.render_seconds;
  j["denoised"] = denoise_seconds.has_value();
  if (denoise_seconds) {
    j["denoiser"] = denoiser_name();
    j["denoise_s"] = *denoise_seconds;
  }
  j["width"] = image.width;
  j["height"] = image.height;
  j["spp"] = result.spp;
  j["noise"] = result.noise;
  j["samples"] = result.rays.samples;
  j["rays"] = {{"closest", result.rays.closest}, {"shadow", result.rays.shadow}};
  double seconds = std::max(result.render_seconds, 1e-9);
  j["samples_per_s"] = static_cast<double>(result.rays.samples) / seconds;
  j["rays_per_s"] = static_cast<double>(result.rays.closest + result.rays.shadow) / seconds;
  j["threads"] = threads;
  j["seed"] = document.settings.sampler.seed;
  j["nonfinite"] = result.nonfinite.count;
  j["nonfinite_samples"] = nlohmann::ordered_json::array();
  for (const NonFiniteSample& s : result.nonfinite.records)
    j["nonfinite_samples"].push_back(
        {{"pixel", {s.pixel.x, s.pixel.y}}, {"sample", s.sample}, {"depth", s.depth}});
  j["scene_bytes"] = result.scene_bytes;
  j["peak_rss_bytes"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  for (const auto& row : settings_table()) j["settings"][std::string(row.key)] = field_text(row, document);
  return j;
}

/// The picture's error against the reference, for denoised pictures also the error before denoising.
std::string reference_json(const Image& picture, const Image* noisy, const Image& reference) {
  std::string text = comparison_json(compare_images(picture, reference));
  if (noisy == nullptr) return text;
  auto json = nlohmann::ordered_json::parse(text);
  json["noisy"] = nlohmann::ordered_json::parse(comparison_json(compare_images(*noisy, reference)));
  return json.dump(2);
}

std::string rate_text(const OfflineProgress& p) {
  return fmt::format("{} spp, {:.2f} Msamples/s", p.spp,
                     static_cast<double>(p.rays.samples) / std::max(p.render_seconds, 1e-9) / 1e6);
}

/// Checks the outputs before the render, so that it is not lost.
void check_render_outputs(const RenderOptions& options, const std::vector<std::string>& pictures,
                          const std::vector<Aov>& aovs, std::vector<std::string> inputs) {
  std::vector<PlannedOutput> planned;
  for (const std::string& path : pictures) {
    image_format_of(path);
    if (path.starts_with('=')) // -o=FILE is -o with the file =FILE
      throw usage_error("-o" + path, "the name begins with '='", fmt::format("write -o {}", path.substr(1)));
    planned.push_back({"-o", path});
  }
  for (const Aov& aov : aovs)
    for (const std::string& path : aov_paths(aov, pictures)) planned.push_back({"--aov", path});
  if (options.stats) planned.push_back({"--stats", *options.stats});
  if (options.reference) inputs.push_back(*options.reference);
  if (options.scene.path != options.reference && !is_image_name(options.scene.path))
    inputs.push_back(options.scene.path); // a picture may be rendered again over itself
  check_outputs(planned, inputs);
}

/// The scene's textures, panoramas and photometric files.
std::vector<std::string> picture_files(const SceneDesc& scene) {
  std::vector<std::string> files;
  for (const auto& texture : scene.textures)
    if (const auto* image = texture->image()) files.push_back(image->source);
  for (const LightDesc& light : scene.lights) {
    if (const auto panorama = light_panorama(light))
      files.insert(files.end(), panorama->sources.begin(), panorama->sources.end());
    if (const auto profile = light_profile(light)) files.push_back(profile->source);
  }
  std::erase(files, "");
  return files;
}

/// The film's part that is written.
ivec2 picture_size(const FilmSettings& film, const CropWindow& crop) {
  return crop.width > 0 ? ivec2(crop.width, crop.height) : ivec2(film.width, film.height);
}

void check_reference(const Image& reference, const std::string& path, ivec2 size) {
  if (reference.width == size.x && reference.height == size.y) return;
  throw input_error(
      {path}, "reference",
      fmt::format("it has {}x{} pixels, the render {}x{}", reference.width, reference.height, size.x, size.y),
      "render at the reference's --size");
}

void warn_of_nonfinite(const NonFiniteLog& log) {
  if (log.count == 0) return;
  const NonFiniteSample& first = log.records.front();
  say("candela: warning: {} samples were not finite and are left out; the first is pixel {},{} sample {} at "
      "depth {}\n",
      log.count, first.pixel.x, first.pixel.y, first.sample, first.depth);
}

} // namespace

int run_render(const RenderOptions& options) {
  const std::vector<Aov> aovs = parse_aovs(options.aovs);
  check_render_outputs(options, options.outputs, aovs, {});
  std::optional<Image> reference;
  if (options.reference) {
    check_stdout();
    reference = read_image(*options.reference);
  }
  auto load_start = std::chrono::steady_clock::now();
  SceneOptions scene_options = options.scene;
  scene_options.settings.clear(); // applied after the other options
  LoadedScene loaded = load_scene(scene_options);
  double load_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - load_start).count();

  OfflineOptions offline;
  if (loaded.crop)
    offline.pass.crop = {loaded.crop->x, loaded.crop->y, loaded.crop->width, loaded.crop->height};
  const FilmSettings loaded_film = loaded.document.settings.film;
  apply_options(options, loaded.document, offline.pass);
  const FilmSettings& film = loaded.document.settings.film;
  if (!options.crop && (film.width != loaded_film.width || film.height != loaded_film.height))
    offline.pass.crop = {}; // the crop is relative to another film size
  const std::vector<std::string> outputs = options.outputs.empty() ? loaded.output_files : options.outputs;
  if (outputs.empty()) throw usage_error("render", "there is nowhere to write to", "add -o FILE");
  check_render_outputs(options, outputs, aovs, picture_files(loaded.document.scene));
  check_aovs(aovs, loaded.document);
  if (reference) check_reference(*reference, *options.reference, picture_size(film, offline.pass.crop));
  offline.components = needs_components(aovs);

  ProgressBar bar(options.quiet);
  offline.stop = &stop_requested;
  offline.progress = [&](const OfflineProgress& p) { bar.update(p.fraction, rate_text(p)); };
  OfflineResult result;
  const SignalGuard guard;
  try {
    result = render_document(loaded.document, offline);
  } catch (const Cancelled&) {
    say("candela: interrupted while the scene was built; there is nothing to save\n");
    return interrupted_status();
  }
  const Image image = view_image(result.film, loaded.document.settings.view);
  const std::optional<DenoisedPicture> denoised = denoised_picture(loaded.document, result, offline.pass);
  const Image& shown = denoised ? denoised->image : image;
  PictureState state{loaded.document, std::max(result.spp, 1), {}};
  if (const CropWindow& c = offline.pass.crop; c.width > 0) state.crop = {c.x, c.y, c.width, c.height};
  OutputWriter writer;
  std::vector<std::string> written = outputs;
  for (const std::string& path : outputs)
    writer.attempt(path, [&] {
      const ImageMetadata metadata = picture_metadata(result.spp, denoised.has_value());
      write_picture(shown, path, loaded.document.settings.display, loaded.document.settings.view,
                    result.display_scale, options.no_state ? metadata : with_state(metadata, state, path),
                    result.film.origin());
    });
  for (const std::string& path : write_aovs(aovs, outputs, loaded.document, result, offline, writer))
    written.push_back(path);

  int threads = options.scene.threads > 0 ? options.scene.threads : omp_get_num_procs();
  if (options.stats)
    writer.attempt(*options.stats, [&] {
      write_file_atomically(*options.stats,
                            stats_json(loaded.document, result, image, load_seconds,
                                       denoised ? std::optional(denoised->seconds) : std::nullopt, threads)
                                    .dump(2) +
                                "\n");
    });
  if (writer.code() == ExitCode::done)
    bar.finish(
        fmt::format("{} spp in {:.2f} s, {:.2f} Msamples/s: {}", result.spp, result.render_seconds,
                    static_cast<double>(result.rays.samples) / std::max(result.render_seconds, 1e-9) / 1e6,
                    fmt::join(written, ", ")));
  warn_of_nonfinite(result.nonfinite);
  if (result.missing > 0)
    say("candela: warning: the render ended before every pixel had a sample: {:.1f} % of them have none and "
        "repeat a neighbour where there is one\n",
        100 * result.missing);
  if (reference) print_result(reference_json(shown, denoised ? &image : nullptr, *reference) + "\n");
  if (writer.code() != ExitCode::done) return static_cast<int>(writer.code());
  if (!result.interrupted) return 0;
  say("candela: interrupted; what was rendered is saved\n");
  return interrupted_status();
}

} // namespace candela
