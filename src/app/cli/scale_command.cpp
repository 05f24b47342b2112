#include "app/cli/scale_command.h"

#include "app/bench/scale_report.h"
#include "app/bench/scale_scenes.h"
#include "app/console/outputs.h"
#include "app/figures/figure.h"
#include "app/platform/data_file.h"
#include "app/platform/load_average.h"
#include "app/platform/separate_process.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace candela {

namespace {

constexpr const char* kLandscapePart = "landscape";
constexpr const char* kStones = "stones";
constexpr const char* kSpheres = "ten_thousand_spheres";
constexpr const char* kLights = "many_lights";
constexpr const char* kSweep = "sweep";

/// Sizes of scenes and pictures.
struct Extent {
  std::size_t landscape = 1'000'000;
  std::vector<std::size_t> landscapes = {1'000, 4'000, 16'000, 64'000, 256'000, 1'000'000, 4'000'000};
  int instances = 1'000;
  std::size_t stone = 100'000;
  std::vector<std::size_t> stones = {100, 1'000, 10'000, 100'000};
  ScaleDetail detail;
  ivec2 size{960, 540};
  int rounds = 5;
  ivec2 picture_size{3840, 2160};
  int picture_spp = 64;
};

Extent short_extent() {
  return {4'000, {1'000, 4'000}, 20, 1'000, {100, 1'000}, {128, 64, 128}, {64, 36}, 1, {96, 54}, 2};
}

ivec2 size_of(const std::optional<std::string>& text, const char* option, ivec2 otherwise) {
  if (!text) return otherwise;
  const std::vector<int> parts = integers(*text, 'x', 2, option, "WxH, such as 3840x2160");
  if (parts[0] < 1 || parts[1] < 1 || parts[0] > 16384 || parts[1] > 16384)
    throw usage_error(fmt::format("{} {}", option, *text), "a picture has from 1 to 16384 pixels a side",
                      "write WxH, such as 3840x2160");
  return {parts[0], parts[1]};
}

/// The user's folder, or a temporary one that the destructor removes.
class OutputFolder {
public:
  explicit OutputFolder(const std::optional<std::string>& kept) : kept_(kept.has_value()) {
    std::error_code failed;
    if (kept_) {
      path_ = *kept;
      std::filesystem::create_directories(path_, failed);
    } else {
      path_ = (std::filesystem::temp_directory_path() / "candela-scale-XXXXXX").string();
      if (::mkdtemp(path_.data()) == nullptr) failed = std::error_code(errno, std::generic_category());
    }
    if (failed)
      throw Error(ExitCode::output, fmt::format("{}: folder: {}: name one that you may write to with -o",
                                                path_, failed.message()));
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

private:
  std::string path_;
  bool kept_;
};

class ScaleRun {
public:
  ScaleRun(const ScaleBenchOptions& options, const Extent& extent)
      : options_(options), extent_(extent), folder_(options.folder) {}

  ScaleReport run() {
    for (const std::string& scene : options_.scenes) report_.scenes.push_back(measured(scene, scene));
    if (!options_.scenes.empty()) return std::move(report_);
    if (wants(kLandscapePart) || wants(kStones) || wants(kSweep) || options_.picture)
      written("textures and sky", [this] {
        write_scale_assets(folder_.path(), extent_.detail);
        return folder_.path();
      });
    std::string landscape;
    if (wants(kLandscapePart) || options_.picture)
      landscape = write_mountains(kLandscapePart, extent_.landscape);
    if (wants(kLandscapePart)) report_.scenes.push_back(measured(landscape, kLandscapePart));
    if (wants(kStones)) report_.scenes.push_back(measured(write_spiral(kStones, extent_.stone), kStones));
    for (const char* bundled : {kSpheres, kLights})
      if (wants(bundled))
        report_.scenes.push_back(
            measured(find_data_file(fmt::format("scenes/{}.json", bundled)).string(), bundled));
    if (wants(kSweep)) sweep();
    if (options_.picture) report_.picture = pictured(landscape);
    return std::move(report_);
  }

private:
  bool wants(const char* part) const {
    return options_.only.empty() || std::ranges::find(options_.only, part) != options_.only.end();
  }

  void say(const std::string& what) const {
    if (!options_.quiet) candela::say("candela: {}\n", what);
  }

  std::string written(const std::string& what, const std::function<std::string()>& write) const {
    say(fmt::format("writing {}", what));
    return run_separately(write);
  }

  std::string write_mountains(const std::string& name, std::size_t triangles) const {
    return written(name, [&] { return write_landscape(folder_.path(), name, triangles); });
  }
  std::string write_spiral(const std::string& name, std::size_t triangles) const {
    return written(name, [&] { return write_stones(folder_.path(), name, extent_.instances, triangles); });
  }

  SceneOptions scene_options(const std::string& path) const {
    SceneOptions out;
    out.path = path;
    out.threads = options_.threads;
    return out;
  }

  ScaleResult measured(const std::string& path, const std::string& name) const {
    say(fmt::format("measuring {}", name));
    return scale_result(run_separately(
        [&] { return to_json(measure_scene(scene_options(path), name, extent_.size, extent_.rounds)); }));
  }

  /// The scenes of all sizes; results that exist already are reused.
  void sweep() {
    auto known = [this](const char* name) -> const ScaleResult* {
      const auto found = std::ranges::find(report_.scenes, name, &ScaleResult::name);
      return found != report_.scenes.end() ? &*found : nullptr;
    };
    for (std::size_t n : extent_.landscapes) {
      const ScaleResult* same = n == extent_.landscape ? known(kLandscapePart) : nullptr;
      const std::string name = fmt::format("{}_{}", kLandscapePart, n);
      report_.landscapes.push_back(same ? *same : measured(write_mountains(name, n), name));
    }
    for (std::size_t n : extent_.stones) {
      const ScaleResult* same = n == extent_.stone ? known(kStones) : nullptr;
      const std::string name = fmt::format("{}_{}", kStones, n);
      report_.stones.push_back(same ? *same : measured(write_spiral(name, n), name));
    }
  }

  ScalePicture pictured(const std::string& scene) const {
    say(fmt::format("rendering {}", *options_.picture));
    return scale_picture(run_separately([&] {
      return to_json(render_scale_picture(scene_options(scene), extent_.picture_size, extent_.picture_spp,
                                          *options_.picture));
    }));
  }

  const ScaleBenchOptions& options_;
  const Extent& extent_;
  OutputFolder folder_;
  ScaleReport report_;
};

void write_plot(const ScaleReport& report, const std::string& path) {
  Figure figure;
  FigurePanel panel;
  panel.plot = scale_plot(report);
  figure.scale = 2;
  figure.panels.push_back(std::move(panel));
  const RgbPicture picture = draw_figure(figure, Typeface::installed());
  write_srgb8_image(picture.width, picture.height, picture.rgb, path);
}

} // namespace

std::vector<std::string> scale_parts() { return {kLandscapePart, kStones, kSpheres, kLights, kSweep}; }

int run_scale_bench(const ScaleBenchOptions& o) {
  Extent extent = o.short_run ? short_extent() : Extent{};
  extent.size = size_of(o.size, "--size", extent.size);
  extent.picture_size = size_of(o.picture_size, "--picture-size", extent.picture_size);
  extent.rounds = o.rounds.value_or(extent.rounds);
  extent.picture_spp = o.picture_spp.value_or(extent.picture_spp);
  // Checked before the work.
  check_stdout();
  std::vector<PlannedOutput> outputs;
  for (const auto& [option, path] :
       {std::pair("--plot", o.plot), {"--picture", o.picture}, {"--json", o.json}}) {
    if (!path) continue;
    if (path != o.json) image_format_of(*path);
    outputs.push_back({option, *path});
  }
  check_outputs(outputs, o.scenes);
  const double load = load_average();
  ScaleReport report = ScaleRun(o, extent).run();
  report.load = {load, load_average()};
  OutputWriter writer;
  if (o.json) writer.attempt(*o.json, [&] { write_file_atomically(*o.json, scale_json(report)); });
  if (o.plot) writer.attempt(*o.plot, [&] { write_plot(report, *o.plot); });
  print_result(scale_tables(report, o.markdown ? TableFormat::markdown : TableFormat::text));
  return static_cast<int>(writer.code());
}

} // namespace candela
