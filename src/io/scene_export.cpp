#include "io/scene_export.h"

#include "io/candela/candela_json.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/volumes/cvol_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace candela {

namespace fs = std::filesystem;

namespace {

class PictureCopier {
public:
  explicit PictureCopier(const std::string& path)
      : folder_(folder_of(path)), copies_(fs::path(folder_) / (fs::path(path).stem().string() + "_files")) {}

  /// The path by which the scene refers to the picture (or another file that is copied as it is); empty if
  /// the file is missing, so that it is written inline.
  std::string reachable(const std::string& source, const char* element = "image") {
    if (source.empty() || path_below(folder_, source)) return source;
    if (auto known = done_.find(source); known != done_.end()) return known->second;
    std::error_code failed;
    if (!fs::is_regular_file(source, failed)) return "";
    const std::string to = place_for(fs::path(source).filename());
    write_file_atomically(to, std::span<const std::uint8_t>(read_file_bytes(source, element)));
    copied.push_back({source, to});
    return done_[source] = to;
  }

  /// The path of a new file beside the copies, which write(path) writes.
  template <class Write>
  std::string written(std::string name, Write write) {
    std::ranges::replace_if(
        name, [](unsigned char c) { return c < ' ' || c == '/' || c == '\\' || c == ':'; }, '_');
    const std::string to = place_for(name);
    write(to);
    return to;
  }

  std::vector<ExportedFile> copied;

private:
  std::string place_for(const fs::path& name) {
    std::error_code failed;
    fs::path to = copies_ / name;
    for (int i = 2; !taken_.insert(to).second; ++i)
      to = copies_ / fmt::format("{}-{}{}", name.stem().string(), i, name.extension().string());
    fs::create_directories(copies_, failed);
    if (failed) throw output_error(copies_.string(), failed.message(), "choose another place");
    return to.string();
  }

  std::string folder_;
  fs::path copies_;
  std::map<std::string, std::string> done_;
  std::set<fs::path> taken_;
};

} // namespace

std::vector<ExportedFile> export_candela_json(Document document, const std::string& path) {
  if (auto problem = document_problem(document); !problem.empty()) // before anything is copied
    throw output_error("scene", problem, "correct it before writing");
  PictureCopier copier(path);
  for (auto& texture : document.scene.textures) {
    const ImageTexture* image = texture->image();
    if (image == nullptr) continue;
    std::string source = copier.reachable(image->source);
    if (source == image->source) continue;
    auto moved = std::make_shared<Texture>(*texture);
    std::get<ImageTexture>(moved->model).source = source;
    texture = std::move(moved);
  }
  for (LightDesc& light : document.scene.lights) {
    if (const auto profile = light_profile(light)) {
      std::string source = copier.reachable(profile->source);
      if (source != profile->source) {
        auto moved = std::make_shared<IesProfile>(*profile);
        moved->source = std::move(source);
        set_profile(light, std::move(moved));
      }
    }
    const auto panorama = light_panorama(light);
    if (!panorama) continue;
    std::vector<std::string> sources;
    for (const std::string& source : panorama->sources) sources.push_back(copier.reachable(source));
    if (std::ranges::find(sources, "") != sources.end()) sources.clear();
    if (sources == panorama->sources) continue;
    auto moved = std::make_shared<Panorama>(*panorama);
    moved->sources = std::move(sources);
    set_panorama(light, std::move(moved));
  }
  for (MediumDesc& medium : document.scene.media) {
    const auto grid = medium_grid(medium);
    if (!grid) continue;
    std::string source = copier.reachable(grid->source, "volume");
    if (source.empty())
      source = copier.written(medium.name + ".cvol", [&](const std::string& to) { write_cvol(*grid, to); });
    if (source == grid->source) continue;
    auto moved = std::make_shared<VolumeGrid>(*grid);
    moved->source = std::move(source);
    set_medium_grid(medium, std::move(moved));
  }
  for (Instance& instance : document.scene.instances) {
    auto* curves = std::get_if<CurvesShape>(&instance.shape);
    if (curves == nullptr) continue;
    std::string source = copier.reachable(curves->strands->source, "curves");
    if (source == curves->strands->source) continue;
    auto moved = std::make_shared<Strands>(*curves->strands);
    moved->source = std::move(source);
    curves->strands = std::move(moved);
  }
  write_candela_json(document, path);
  return std::move(copier.copied);
}

} // namespace candela
