#pragma once
// From Documents to scenes: the newest one that was built, and what of it serves the next.

#include "core/progress.h"
#include "render/world/render_scene.h"
#include "session/geometry_cache.h"

namespace candela {

/// Whether a scene of `before` that is being built is of no use for `now`: it has other meshes or panoramas.
bool is_built_anew(const SceneDesc& before, const SceneDesc& now);

/// The render thread builds. What others see is guarded by the session's mutex.
class SceneCache {
public:
  struct Built {
    std::shared_ptr<const RenderScene> scene;
    std::shared_ptr<const Document> document; ///< what it was built from
  };

  /// `geometry_of`: a scene of another session whose geometry and lights serve the first one; may be null.
  SceneCache(SessionMonitor& monitor, WorkerThreads& workers, GeometryCache::OnBuild on_build,
             std::shared_ptr<const RenderScene> geometry_of);

  /// Newest that was built; null before.
  Built newest(Locked) const { return newest_; }

  /// From begin() to end() a scene is in the making.
  void begin(Locked) { building_ = std::make_shared<Progress>(); }
  void end(Locked) { building_.reset(); }
  bool is_building(Locked) const { return building_ != nullptr; }
  void cancel(Locked) {
    if (building_) building_->cancel();
  }
  double built_share(Locked) const { return building_ ? building_->share() : 0; }

  /// Render thread: a scene of the document; throws Cancelled.
  std::shared_ptr<const RenderScene> build(const Document& document);
  /// Render thread: it is the newest.
  void adopt(Locked, std::shared_ptr<const RenderScene> scene, const Document& document);

  /// Render thread: the newest scene with better geometry, where that has been built and `document` is what
  /// it shows; else null.
  std::shared_ptr<const RenderScene> build_improved(const Document& document);
  void adopt_improved(Locked, std::shared_ptr<const RenderScene> scene);

  GeometryCache& geometry() { return geometry_; }

private:
  SessionMonitor& monitor_;
  std::shared_ptr<const RenderScene> geometry_of_;
  std::shared_ptr<Progress> building_; ///< null: nothing is
  Built newest_;                       ///< written by the render thread alone
  GeometryCache geometry_;
};

} // namespace candela
