#include "session/geometry_cache.h"

#include "render/world/render_scene.h"

#include <algorithm>
#include <utility>

namespace candela {

namespace {

/// Priority of the geometry thread, below the renderer's.
constexpr int kGeometryNiceness = 15;
/// Seconds after the last edit of geometry before better geometry is built: each step of a drag would discard
/// it.
constexpr double kRest = 0.3;

} // namespace

std::set<const Mesh*> meshes_of(const std::vector<Instance>& instances) {
  std::set<const Mesh*> meshes;
  for (const Instance& instance : instances)
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape))
      meshes.insert(mesh->get());
  return meshes;
}

GeometryCache::GeometryCache(SessionMonitor& monitor, WorkerThreads& workers, OnBuild on_build)
    : monitor_(monitor), on_build_(std::move(on_build)),
      thread_([&workers] { workers.start(kGeometryNiceness); },
              [this](const GeometryJob& job, std::shared_ptr<const Geometry> made) {
                receive(job, std::move(made));
              }) {}

std::shared_ptr<const Geometry> GeometryCache::geometry_for(const std::vector<Instance>& instances,
                                                            const RenderScene* previous, Progress& progress) {
  candidate_ = find(instances, previous, progress);
  return candidate_.geometry;
}

GeometryCache::Built GeometryCache::find(const std::vector<Instance>& instances, const RenderScene* previous,
                                         Progress& progress) {
  Geometry::Objects known;
  {
    const auto lock = monitor_.lock();
    if (improvement_ && improvement_->geometry && improvement_->is_of(instances)) return *improvement_;
    known = objects_;
  }
  if (in_use_.is_of(instances)) return in_use_;
  if (candidate_.is_of(instances)) return candidate_;
  const auto copy = std::make_shared<const std::vector<Instance>>(instances);
  if (previous != nullptr && previous->instances() == instances) return {copy, previous->shared_geometry()};
  const bool moved =
      previous != nullptr && std::ranges::includes(meshes_of(previous->instances()), meshes_of(instances));
  if (on_build_) on_build_(progress);
  return {copy,
          Geometry::build(instances, moved ? BuildQuality::fast : BuildQuality::high, &progress, known)};
}

void GeometryCache::adopt(Locked) {
  if (in_use_.geometry == candidate_.geometry) return;
  in_use_ = candidate_;
  improvement_.reset();
  keep_objects(*in_use_.geometry, *in_use_.instances);
  stays_fast_ = false;
  if (in_use_.geometry->quality() == BuildQuality::fast)
    thread_.post({in_use_.instances, BuildQuality::high, objects_, kRest});
  else
    thread_.cancel();
}

/// Drops the objects of meshes that are no longer used.
void GeometryCache::keep_objects(const Geometry& geometry, const std::vector<Instance>& instances) {
  std::set<const Mesh*> wanted = meshes_of(instances);
  std::erase_if(objects_, [&](const auto& object) { return wanted.erase(object->mesh.get()) == 0; });
  for (const auto& object : geometry.objects())
    if (wanted.erase(object->mesh.get()) != 0) objects_.push_back(object);
}

/// On the geometry thread.
void GeometryCache::receive(const GeometryJob& job, std::shared_ptr<const Geometry> made) {
  {
    const auto lock = monitor_.lock();
    if (made && in_use_.is_of(*job.instances)) keep_objects(*made, *job.instances);
    if (job.quality == BuildQuality::high) improvement_ = Built{job.instances, std::move(made)};
  }
  monitor_.changed.notify_all();
}

bool GeometryCache::improving(Locked) const {
  return in_use_.geometry && in_use_.geometry->quality() == BuildQuality::fast && !stays_fast_;
}

std::shared_ptr<const Geometry> GeometryCache::take_improvement(Locked lock) {
  const std::optional<Built> better = std::exchange(improvement_, std::nullopt);
  if (!better || !improving(lock) || !in_use_.is_of(*better->instances)) return nullptr;
  if (!better->geometry) stays_fast_ = true;
  return better->geometry;
}

void GeometryCache::prepare_moves(Locked) {
  if (!in_use_.geometry || in_use_.geometry->quality() == BuildQuality::fast) return;
  thread_.post({in_use_.instances, BuildQuality::fast, objects_, 0});
}

} // namespace candela
