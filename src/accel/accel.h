#pragma once
// The acceleration structure: what a ray hits first, and whether it hits anything at all.
//
// One bounding volume hierarchy over triangles, spheres, discs, curves and instances of other hierarchies;
// instances, and the vertices of triangles, may move with the time of the ray. It knows geometry only: no
// materials, normals or textures. The caller gets which primitive was hit, at which t and at which
// barycentrics, and computes the rest from its own data.
//
// Triangles are watertight: a ray that passes exactly through an edge or a vertex that triangles share hits
// at least one of them. The closest hit, the any-hit answer and the tree are the same for any number of
// threads and for any SIMD instruction set, and the hits do not depend on the batch that rays are traced in.
// Of primitives that are hit at the same t the first is found (but where one is seen so nearly edge-on that
// its t is unsure).

#include "accel/primitives/primitive_kinds.h"
#include "core/bounds.h"
#include "core/progress.h"
#include "core/ray.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace candela {

inline constexpr std::uint32_t kNoInstance = 0xffffffffu;

struct Hit {
  float t = kInfinity;
  /// Barycentric weights of vertices 1 and 2 (vertex 0 has 1 - u - v) for triangles; u along the segment for
  /// curves; 0 otherwise.
  float u = 0, v = 0;
  std::uint32_t primitive = 0; ///< index into the input array of its kind (the object's, if instanced)
  /// Index into AccelInput::instances, or into moving_instances, with the bit kMovingInstance.
  std::uint32_t instance = kNoInstance;
  PrimitiveKind kind = PrimitiveKind::triangle;
};

/// What a closest-hit ray costs: nodes of up to 8 boxes and packs of up to 8 primitives that it tests, those
/// of instances included.
struct TraversalCost {
  std::uint32_t nodes = 0, packs = 0;
};

enum class BuildQuality {
  fast, ///< coarser bins and a greedy collapse: for scenes under edit
  high, ///< the wide tree of least expected cost
};

struct AccelStats {
  std::array<std::size_t, accel_detail::PrimitiveKinds::kCount> primitives{}; ///< in the tree, of each kind
  /// Left out: a vertex that is not finite or out of range, no area, a radius that is not positive, a
  /// singular matrix, an empty object.
  std::size_t skipped = 0;
  std::size_t nodes = 0;  ///< of up to 8 children
  std::size_t leaves = 0; ///< of up to 8 primitives of one kind
  int depth = 0;          ///< nodes on the longest way from the root to a leaf
  /// Expected cost of a random line through the bounds, in node visits (surface area heuristic; Goldsmith and
  /// Salmon 1987), as the traversal costs are weighed in the builder.
  double sah_cost = 0;
  std::size_t bytes = 0; ///< without the objects of instances

  std::size_t count(PrimitiveKind kind) const { return primitives[accel_detail::number(kind)]; }
};

struct AccelTree;

/// Const after the build; any number of threads may trace at once. Movable; an empty one hits nothing.
class Accel {
public:
  Accel();
  ~Accel();
  Accel(Accel&&) noexcept;
  Accel& operator=(Accel&&) noexcept;

  /// Uses the threads that OpenMP gives it; the tree does not depend on their number. Throws Error
  /// (ExitCode::limit) above 2^28 primitives, above 2^27 leaves of one kind, or for nested instances;
  /// Cancelled soon after `progress`, which may be null, is told to end. The caller has progress->expect()
  /// build_work() of the input's primitives.
  static Accel build(const AccelInput& input, BuildQuality quality = BuildQuality::high,
                     Progress* progress = nullptr);
  /// The work of a build from so many primitives, of all kinds together.
  static std::uint64_t build_work(std::size_t primitives);

  /// The closest hit with t in (t_min, t_max), or nothing. A negative t_min counts as 0. The direction is of
  /// any length from 1e-18 to 1e18; a ray that is not finite hits nothing.
  std::optional<Hit> intersect(const Ray& ray) const;
  /// The same without an optional to copy; `hit` is undefined where nothing is hit.
  bool intersect(const Ray& ray, Hit& hit) const;
  /// The same for many rays at once: hits[i] is that of *rays[i], its t infinite where nothing is hit. There
  /// are as many hits, or more. Faster if neighbours in the list are neighbours in space, as camera rays are.
  void intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const;
  /// Whether there is any hit with t in (t_min, t_max): exactly when intersect finds one.
  bool occluded(const Ray& ray) const;
  /// The same for many rays, as intersect() has it: result[i] is that of *rays[i].
  void occluded(std::span<const Ray* const> rays, std::span<bool> result) const;
  /// What intersect(ray) costs.
  TraversalCost cost(const Ray& ray) const;

  Bounds3 bounds() const; ///< of what is in the tree; empty if nothing is
  std::size_t memory_bytes() const;
  AccelStats stats() const;

private:
  explicit Accel(std::unique_ptr<const AccelTree> tree);
  std::unique_ptr<const AccelTree> tree_;
  friend struct AccelAccess;
};

} // namespace candela
