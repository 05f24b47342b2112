#include "scene/scene_files.h"

namespace candela {

std::set<std::string> source_files(const SceneDesc& scene) {
  std::set<std::string> files;
  for (const Instance& instance : scene.instances)
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape))
      files.insert({(*mesh)->source, (*mesh)->source_end});
    else if (const auto* curves = std::get_if<CurvesShape>(&instance.shape))
      files.insert(curves->strands->source);
  for (const auto& texture : scene.textures)
    if (const auto* image = texture->image()) files.insert(image->source);
  for (const LightDesc& light : scene.lights) {
    if (const auto profile = light_profile(light)) files.insert(profile->source);
    if (const auto panorama = light_panorama(light))
      files.insert(panorama->sources.begin(), panorama->sources.end());
  }
  for (const MediumDesc& medium : scene.media)
    if (const auto grid = medium_grid(medium)) files.insert(grid->source);
  files.erase("");
  return files;
}

} // namespace candela
