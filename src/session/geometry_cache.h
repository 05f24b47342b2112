#pragma once
// Geometry that outlives edits: built fast while the user moves objects, built well beside the rendering, and
// exchanged when that is done.

#include "session/geometry_thread.h"
#include "session/session_monitor.h"
#include "session/worker_threads.h"

#include <set>

namespace candela {

class RenderScene;

/// The meshes of the instances that have one.
std::set<const Mesh*> meshes_of(const std::vector<Instance>& instances);

/// Members are guarded by the session's mutex, but for those of the render thread.
class GeometryCache {
public:
  /// Called from the render thread before geometry is built with this progress; may be empty.
  using OnBuild = std::function<void(const Progress&)>;

  GeometryCache(SessionMonitor& monitor, WorkerThreads& workers, OnBuild on_build);

  /// Render thread: the geometry of the instances. That of `previous` (may be null) or of the geometry thread
  /// where it is of the same, else built now: fast, if no mesh is new. Throws Cancelled.
  std::shared_ptr<const Geometry> geometry_for(const std::vector<Instance>& instances,
                                               const RenderScene* previous, Progress& progress);
  /// Render thread: what geometry_for() gave last is in use. Begins to improve it if it is fast.
  void adopt(Locked);

  /// Better geometry is still to come.
  bool improving(Locked) const;
  /// It is there.
  bool has_improvement(Locked) const { return improvement_.has_value(); }
  /// Render thread: better geometry of the instances in use; null where there is none after all.
  std::shared_ptr<const Geometry> take_improvement(Locked);
  void adopt_improvement(Locked, std::shared_ptr<const Geometry> geometry) {
    in_use_.geometry = std::move(geometry);
  }

  /// Objects may be moved soon: makes every mesh ready for it.
  void prepare_moves(Locked);

private:
  struct Built {
    std::shared_ptr<const std::vector<Instance>> instances; ///< null: nothing
    std::shared_ptr<const Geometry> geometry;               ///< null: memory does not suffice for it

    bool is_of(const std::vector<Instance>& other) const { return instances && *instances == other; }
  };
  Built find(const std::vector<Instance>& instances, const RenderScene* previous, Progress& progress);
  void receive(const GeometryJob& job, std::shared_ptr<const Geometry> made);
  void keep_objects(const Geometry& geometry, const std::vector<Instance>& instances);

  SessionMonitor& monitor_;
  OnBuild on_build_;
  Built in_use_;                     ///< written by the render thread alone
  Geometry::Objects objects_;        ///< of the meshes in use, as far as they ever were needed
  std::optional<Built> improvement_; ///< made by the geometry thread, not in use yet
  bool stays_fast_ = false;          ///< memory does not suffice for better geometry
  /// The render thread's: what geometry_for() gave last. Not in use where the rest of its scene was
  /// cancelled.
  Built candidate_;
  GeometryThread thread_; // last: it uses the rest
};

} // namespace candela
