// Geometry over edits: built fast while a hand moves things, well beside that, and exchanged when it is
// there.

#include "session/session_state.h"

#include <algorithm>

namespace candela {

std::set<const Mesh*> meshes_of(const std::vector<Instance>& instances) {
  std::set<const Mesh*> meshes;
  for (const Instance& instance : instances)
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape))
      meshes.insert(mesh->get());
  return meshes;
}

bool is_built_anew(const SceneDesc& before, const SceneDesc& now) {
  auto panoramas = [](const SceneDesc& scene) {
    std::set<const Panorama*> all;
    for (const LightDesc& light : scene.lights) all.insert(light.panorama.get());
    return all;
  };
  return (before.instances != now.instances && meshes_of(before.instances) != meshes_of(now.instances)) ||
         (before.lights != now.lights && panoramas(before) != panoramas(now));
}

/// What there is of `previous` or of the geometry thread, or else built now: fast, if no mesh is new.
std::shared_ptr<const Geometry> RenderSession::State::geometry_for(const std::vector<Instance>& instances,
                                                                   const RenderScene* previous) {
  Geometry::Objects known;
  std::shared_ptr<Progress> progress;
  {
    std::lock_guard lock(mutex);
    if (improvement && improvement->geometry && improvement->instances == instances)
      return improvement->geometry;
    known = objects;
    progress = building;
  }
  if (previous != nullptr && previous->instances() == instances) return previous->shared_geometry();
  if (unused && unused->instances == instances) return unused->geometry;
  const bool moved =
      previous != nullptr && std::ranges::includes(meshes_of(previous->instances()), meshes_of(instances));
  if (options.on_build) options.on_build(*progress);
  return Geometry::build(instances, moved ? BuildQuality::fast : BuildQuality::high, progress.get(), known);
}

/// Keeps what has been built of meshes that are still there. The mutex must be held.
void RenderSession::State::keep_objects(const Geometry& geometry, const std::vector<Instance>& instances) {
  std::set<const Mesh*> wanted = meshes_of(instances);
  std::erase_if(objects, [&](const auto& object) { return wanted.erase(object->mesh.get()) == 0; });
  for (const auto& object : geometry.objects())
    if (wanted.erase(object->mesh.get()) != 0) objects.push_back(object);
}

/// On the geometry thread.
void RenderSession::State::take_in(const GeometryJob& job, std::shared_ptr<const Geometry> made) {
  {
    std::lock_guard lock(mutex);
    if (made && scene && scene->instances() == job.instances) keep_objects(*made, job.instances);
    if (job.quality == BuildQuality::high) improvement = Improvement{job.instances, std::move(made)};
  }
  changed.notify_all();
}

/// Goes on with better geometry of the same instances. The picture that is shown stays until there is one of
/// as many samples.
void RenderSession::State::improve() {
  std::optional<Improvement> better;
  {
    std::lock_guard lock(mutex);
    if (!may_improve() || status.phase == SessionPhase::failed) return;
    better.swap(improvement);
  }
  if (!improving() || better->instances != scene->instances()) return;
  if (!better->geometry) {
    stays_fast = true;
    return;
  }
  auto made = RenderScene::build(current, better->geometry, scene.get());
  samples_to_show = rays.samples;
  urgent_first = false;
  begin_accumulation(std::size(kCoarseLevels) - 1);
  std::lock_guard lock(mutex);
  scene = std::move(made);
  status.phase = SessionPhase::rendering;
}

} // namespace candela
