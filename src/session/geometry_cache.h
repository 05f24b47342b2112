#pragma once
// Geometry that is reused across edits: built fast while the user moves objects, and replaced by high-quality
// geometry that is built in the background.

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

  /// Render thread: the geometry of the instances. Reuses that of `previous` (may be null) or of the geometry
  /// thread if it is of the same instances; else builds it, with the fast build if no mesh is new. Throws
  /// Cancelled.
  std::shared_ptr<const Geometry> geometry_for(const std::vector<Instance>& instances,
                                               const RenderScene* previous, Progress& progress);
  /// Render thread: the last result of geometry_for() is in use. If its build was fast, begins to improve it.
  void adopt(Locked);

  /// Whether better geometry is expected.
  bool improving(Locked) const;
  /// Whether better geometry is available.
  bool has_improvement(Locked) const { return improvement_.has_value(); }
  /// Render thread: better geometry of the instances in use; null if there is none.
  std::shared_ptr<const Geometry> take_improvement(Locked);
  void adopt_improvement(Locked, std::shared_ptr<const Geometry> geometry) {
    in_use_.geometry = std::move(geometry);
  }

  /// Objects may be moved soon: prepares every mesh for it.
  void prepare_moves(Locked);

private:
  struct Built {
    std::shared_ptr<const std::vector<Instance>> instances; ///< null: nothing
    std::shared_ptr<const Geometry> geometry;               ///< null: not enough memory

    bool is_of(const std::vector<Instance>& other) const { return instances && *instances == other; }
  };
  Built find(const std::vector<Instance>& instances, const RenderScene* previous, Progress& progress);
  void receive(const GeometryJob& job, std::shared_ptr<const Geometry> made);
  void keep_objects(const Geometry& geometry, const std::vector<Instance>& instances);

  SessionMonitor& monitor_;
  OnBuild on_build_;
  Built in_use_;                     ///< written by the render thread only
  Geometry::Objects objects_;        ///< of the meshes in use, as far as built
  std::optional<Built> improvement_; ///< made by the geometry thread, not in use yet
  bool stays_fast_ = false;          ///< not enough memory for better geometry
  /// Used by the render thread: the last result of geometry_for(). Not in use if building its scene was
  /// cancelled.
  Built candidate_;
  GeometryThread thread_; // last: it uses the other members
};

} // namespace candela
