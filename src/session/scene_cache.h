#pragma once
// Builds scenes from Documents, and reuses parts of the newest one for the next.

#include "core/progress.h"
#include "render/world/render_scene.h"
#include "session/geometry_cache.h"

namespace candela {

/// Whether a scene of `before` that is being built is useless for `now`, which has other meshes or panoramas.
bool is_built_anew(const SceneDesc& before, const SceneDesc& now);

/// The render thread builds. Values that other threads read are guarded by the session's mutex.
class SceneCache {
public:
  struct Built {
    std::shared_ptr<const RenderScene> scene;
    std::shared_ptr<const Document> document; ///< its source
  };

  /// `geometry_of`: a scene of another session whose geometry and lights are reused for the first one; may be
  /// null.
  SceneCache(SessionMonitor& monitor, WorkerThreads& workers, GeometryCache::OnBuild on_build,
             std::shared_ptr<const RenderScene> geometry_of);

  /// The newest built scene; null before the first.
  Built newest(Locked) const { return newest_; }

  /// A scene is being built between begin() and end().
  void begin(Locked) { building_ = std::make_shared<Progress>(); }
  void end(Locked) { building_.reset(); }
  bool is_building(Locked) const { return building_ != nullptr; }
  void cancel(Locked) {
    if (building_) building_->cancel();
  }
  double built_share(Locked) const { return building_ ? building_->share() : 0; }

  /// Render thread: builds a scene of the document; throws Cancelled.
  std::shared_ptr<const RenderScene> build(const Document& document);
  /// Render thread: makes the scene the newest one.
  void adopt(Locked, std::shared_ptr<const RenderScene> scene, const Document& document);

  /// Render thread: the newest scene is that of a document with other factors of the same light layers.
  void set_light_groups(Locked, const std::vector<LightGroup>& groups);

  /// Render thread: the newest scene with better geometry, if that has been built and the scene is that of
  /// `document`; else null.
  std::shared_ptr<const RenderScene> build_improved(const Document& document);
  void adopt_improved(Locked, std::shared_ptr<const RenderScene> scene);

  GeometryCache& geometry() { return geometry_; }

private:
  SessionMonitor& monitor_;
  std::shared_ptr<const RenderScene> geometry_of_;
  std::shared_ptr<Progress> building_; ///< null: nothing is being built
  Built newest_;                       ///< written by the render thread only
  GeometryCache geometry_;
};

} // namespace candela
