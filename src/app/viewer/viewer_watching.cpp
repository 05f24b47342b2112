// Watching the files of the shown scene, and reading again those that have changed.

#include "app/viewer/viewer.h"
#include "io/ies/ies_reader.h"
#include "io/images/panorama_reader.h"
#include "io/images/texels_reader.h"
#include "io/volumes/volume_reader.h"
#include "scene/scene_files.h"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace candela {

namespace fs = std::filesystem;

/// The scene's files, and those dropped on it since. `known`: their stamps when they were just read or
/// written.
void Viewer::watch_files(FileStamps known) {
  std::set<std::string> files = source_files(state_.document.scene);
  for (const auto& [file, stamp] : scene_->files) files.insert(file);
  if (!scene_->path.empty()) files.insert(scene_->path); // perhaps a link, whose target may change
  watch_.watch(std::move(files), std::move(known));
}

/// In the background: `install(fresh)` puts what `read(corrections)` has read in the places of the old one.
/// Corrections are ignored, as when it was dropped.
template <class Read, class Install>
void Viewer::read_again(const std::string& name, Read read, Install install) {
  reader_.post([this, name, read, install]() -> TaskThread::Completion {
    try {
      WarningList corrections;
      auto fresh = read(corrections);
      return [this, name, install, fresh] {
        install(fresh);
        notify(fmt::format("{} was read again", name));
      };
    } catch (const std::exception& error) {
      return [this, problem = std::string(error.what())] { state_.error = problem; };
    }
  });
}

/// Files that the saved scene does not refer to yet are replaced where they are used; edits are kept.
void Viewer::read_dropped_again(const std::set<std::string>& changed) {
  SceneDesc& scene = state_.document.scene;
  std::set<std::shared_ptr<const Panorama>> panoramas;
  std::set<std::shared_ptr<const IesProfile>> profiles;
  for (const LightDesc& light : scene.lights) {
    if (const auto panorama = light_panorama(light);
        panorama && std::ranges::any_of(panorama->sources,
                                        [&](const std::string& source) { return changed.contains(source); }))
      panoramas.insert(panorama);
    if (const auto profile = light_profile(light); profile && changed.contains(profile->source))
      profiles.insert(profile);
  }
  for (const auto& old : panoramas)
    read_again(
        old->name, [old](WarningList& corrections) { return read_panorama(old->sources, corrections); },
        [this, old](const std::shared_ptr<const Panorama>& fresh) {
          for (LightDesc& light : state_.document.scene.lights)
            if (light_panorama(light) == old) set_panorama(light, fresh), state_.edited = true;
        });
  for (const auto& old : profiles)
    read_again(
        old->name, [old](WarningList& corrections) { return read_ies(old->source, corrections); },
        [this, old](const std::shared_ptr<const IesProfile>& fresh) {
          for (LightDesc& light : state_.document.scene.lights)
            if (light_profile(light) == old) set_profile(light, fresh), state_.edited = true;
        });
  std::set<std::shared_ptr<const VolumeGrid>> grids;
  for (const MediumDesc& medium : scene.media)
    if (const auto grid = medium_grid(medium); grid && changed.contains(grid->source)) grids.insert(grid);
  for (const auto& old : grids)
    read_again(
        fs::path(old->source).filename().string(),
        [old](WarningList& corrections) { return read_volume(old->source, corrections); },
        [this, old](const std::shared_ptr<const VolumeGrid>& fresh) {
          for (MediumDesc& medium : state_.document.scene.media)
            if (medium_grid(medium) == old) set_medium_grid(medium, fresh), state_.edited = true;
        });
  for (const auto& old : scene.textures) {
    const ImageTexture* image = old->image();
    if (image == nullptr || !changed.contains(image->source)) continue;
    read_again(
        old->name,
        [name = old->name, source = image->source](WarningList& corrections) {
          return std::make_shared<const Texture>(
              Texture{name, ImageTexture{source, read_texels(source, corrections)}});
        },
        [this, old](const std::shared_ptr<const Texture>& fresh) {
          for (auto& known : state_.document.scene.textures)
            if (known == old) known = fresh, state_.edited = true;
        });
  }
}

void Viewer::look_for_changes() {
  if (state_.reading) return;
  const std::set<std::string> changed = watch_.take_changes();
  if (changed.empty()) return;
  auto is_the_scenes = [&](const std::string& file) {
    return file == scene_->path || scene_->files.contains(file);
  };
  if (std::ranges::none_of(changed, is_the_scenes)) return read_dropped_again(changed);
  if (scene_->path.empty()) return;
  std::error_code failed;
  if (!fs::exists(scene_->path, failed)) return; // an editor may be replacing it
  if (state_.modified)
    state_.question = Question::reload;
  else
    open_scene({scene_->path}, true);
}

} // namespace candela
