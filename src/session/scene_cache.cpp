#include "session/scene_cache.h"

#include <utility>

namespace candela {

bool is_built_anew(const SceneDesc& before, const SceneDesc& now) {
  auto panoramas = [](const SceneDesc& scene) {
    std::set<const Panorama*> all;
    for (const LightDesc& light : scene.lights) all.insert(light_panorama(light).get());
    return all;
  };
  return (before.instances != now.instances && meshes_of(before.instances) != meshes_of(now.instances)) ||
         (before.lights != now.lights && panoramas(before) != panoramas(now));
}

SceneCache::SceneCache(SessionMonitor& monitor, WorkerThreads& workers, GeometryCache::OnBuild on_build,
                       std::shared_ptr<const RenderScene> geometry_of)
    : monitor_(monitor), geometry_of_(std::move(geometry_of)),
      geometry_(monitor, workers, std::move(on_build)) {}

std::shared_ptr<const RenderScene> SceneCache::build(const Document& document) {
  std::shared_ptr<Progress> progress;
  {
    const auto lock = monitor_.lock();
    progress = building_;
  }
  const std::shared_ptr<const RenderScene> previous = newest_.scene ? newest_.scene : geometry_of_;
  auto geometry = geometry_.geometry_for(document.scene.instances, previous.get(), *progress);
  return RenderScene::build(document, std::move(geometry), previous.get(), progress.get());
}

void SceneCache::adopt(Locked lock, std::shared_ptr<const RenderScene> scene, const Document& document) {
  newest_ = {std::move(scene), std::make_shared<const Document>(document)};
  geometry_.adopt(lock);
}

void SceneCache::set_light_groups(Locked, const std::vector<LightGroup>& groups) {
  auto document = std::make_shared<Document>(*newest_.document);
  document->scene.light_groups = groups;
  newest_.document = std::move(document);
}

std::shared_ptr<const RenderScene> SceneCache::build_improved(const Document& document) {
  std::shared_ptr<const Geometry> better;
  {
    const auto lock = monitor_.lock();
    better = geometry_.take_improvement(lock);
  }
  if (!better) return nullptr;
  return RenderScene::build(document, std::move(better), newest_.scene.get());
}

void SceneCache::adopt_improved(Locked lock, std::shared_ptr<const RenderScene> scene) {
  newest_.scene = std::move(scene);
  geometry_.adopt_improvement(lock, newest_.scene->shared_geometry());
}

} // namespace candela
