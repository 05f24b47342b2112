#include "accel/accel.h"

#include "accel/binary_bvh.h"
#include "accel/build_stage.h"
#include "accel/layout.h"
#include "accel/wide_bvh.h"
#include "core/error.h"

#include <algorithm>
#include <atomic>
#include <exception>

namespace candela {

using namespace accel_detail;

namespace {

/// Fewer primitives are built by the caller's thread.
constexpr std::size_t kTeamWork = 4096;

bool usable(vec3 p) {
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
         std::abs(p.z) <= kMaxCoordinate;
}

/// No ray can be said to hit a triangle without a normal. Exact for all but extreme vertices.
bool has_area(vec3 a, vec3 b, vec3 c) {
  glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  return n != glm::dvec3(0);
}

/// Empty if the primitive is to be left out.
Bounds3 triangle_bounds(const AccelInput& input, std::size_t i) {
  Bounds3 b;
  uvec3 t = input.triangles[i];
  std::size_t n = input.vertices.size();
  if (t.x >= n || t.y >= n || t.z >= n) return b;
  vec3 p0 = input.vertices[t.x], p1 = input.vertices[t.y], p2 = input.vertices[t.z];
  if (!usable(p0) || !usable(p1) || !usable(p2) || !has_area(p0, p1, p2)) return b;
  b.grow(p0), b.grow(p1), b.grow(p2);
  return b;
}

/// Grown by what rounding may have cut off.
Bounds3 padded(vec3 center, vec3 extent) {
  vec3 pad = (glm::abs(center) + extent) * 0x1p-22f;
  return {center - extent - pad, center + extent + pad};
}

Bounds3 sphere_bounds(const AccelInput& input, std::size_t i) {
  const SphereGeometry& s = input.spheres[i];
  if (!usable(s.center) || !(s.radius > 0 && s.radius <= kMaxCoordinate)) return {};
  return padded(s.center, vec3(s.radius));
}

Bounds3 disc_bounds(const AccelInput& input, std::size_t i) {
  const DiscGeometry& d = input.discs[i];
  if (!usable(d.center) || !(d.radius > 0 && d.radius <= kMaxCoordinate)) return {};
  if (!is_finite(d.normal) || d.normal == vec3(0)) return {};
  // The extent along an axis is that of a circle: r sqrt(1 - n_i^2), here free of cancellation.
  vec3 n2 = d.normal * d.normal;
  vec3 tangent = glm::sqrt(vec3(n2.y + n2.z, n2.z + n2.x, n2.x + n2.y));
  return padded(d.center, d.radius * tangent);
}

glm::dmat4 to_double(const mat4& m) { return glm::dmat4(m); }

Bounds3 instance_bounds(const AccelInput& input, std::size_t i) {
  const InstanceGeometry& instance = input.instances[i];
  if (!instance.object) return {};
  Bounds3 local = instance.object->bounds(), result;
  if (local.empty()) return result;
  glm::dmat4 m = to_double(instance.world_from_object);
  double determinant = glm::determinant(glm::dmat3(m));
  if (!std::isfinite(determinant) || determinant == 0) return result;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec4 p(corner & 1 ? local.hi.x : local.lo.x, corner & 2 ? local.hi.y : local.lo.y,
                 corner & 4 ? local.hi.z : local.lo.z, 1);
    vec3 q(m * p);
    if (!usable(q)) return {};
    result.grow(q);
  }
  return padded(result.center(), 0.5f * result.diagonal());
}

/// Refs of the primitives that can be hit.
struct RefList {
  HugeVector<BuildRef> refs;
  RangeBounds bounds;
  std::uint32_t kinds = 0;

  /// Appends a ref for every primitive of a kind that can be hit; gives how many.
  template <class BoundsOf>
  std::size_t append(LeafKind kind, std::size_t count, BoundsOf bounds_of, const BuildStage& stage) {
    const std::size_t first = refs.size();
    refs.resize(first + count);
    // In chunks, each of which closes its own gaps: they are closed at once where nothing was left out.
    const std::size_t chunks = count / 4096 + 1;
    std::vector<std::size_t> used(chunks, 0);
    std::vector<RangeBounds> bounds_in(chunks);
    auto begin = [&](std::size_t chunk) { return first + count * chunk / chunks; };
#pragma omp taskloop default(shared) num_tasks(kLoopTasks)
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      if (stage.cancelled()) continue;
      RangeBounds mine;
      BuildRef* const first_out = refs.data() + begin(chunk);
      BuildRef* out = first_out;
      for (std::size_t i = begin(chunk); i < begin(chunk + 1); ++i) {
        const Bounds3 b = bounds_of(i - first);
        if (b.empty()) continue;
        *out = BuildRef::make(b, static_cast<std::uint32_t>(i - first), kind);
        mine.grow(*out++);
      }
      used[chunk] = static_cast<std::size_t>(out - first_out);
      bounds_in[chunk] = mine;
    }
    stage.check();
    for (const RangeBounds& b : bounds_in) bounds.merge(b);
    std::size_t end = first;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      if (end != begin(chunk)) std::copy_n(refs.data() + begin(chunk), used[chunk], refs.data() + end);
      end += used[chunk];
    }
    refs.resize(end);
    if (end > first) kinds |= 1u << static_cast<std::uint32_t>(kind);
    return end - first;
  }
};

InstanceRecord make_instance(const AccelInput& input, std::uint32_t index) {
  const InstanceGeometry& instance = input.instances[index];
  glm::dmat4 inverse = glm::inverse(to_double(instance.world_from_object));
  return {AccelAccess::tree(*instance.object), glm::mat4x3(mat4(inverse)), index};
}

void set_lane(TrianglePack& pack, std::uint32_t lane, const AccelInput& input, std::uint32_t index) {
  for (int k = 0; k < 3; ++k) {
    const vec3 p = input.vertices[input.triangles[index][k]];
    for (int a = 0; a < 3; ++a)
      pack.vertex[static_cast<std::size_t>(k)][static_cast<std::size_t>(a)][lane] = p[a];
  }
}

void set_lane(SpherePack& pack, std::uint32_t lane, const AccelInput& input, std::uint32_t index) {
  const SphereGeometry& s = input.spheres[index];
  for (int a = 0; a < 3; ++a) pack.center[static_cast<std::size_t>(a)][lane] = s.center[a];
  pack.radius[lane] = s.radius;
}

void set_lane(DiscPack& pack, std::uint32_t lane, const AccelInput& input, std::uint32_t index) {
  const DiscGeometry& d = input.discs[index];
  for (int a = 0; a < 3; ++a) {
    pack.center[static_cast<std::size_t>(a)][lane] = d.center[a];
    pack.normal[static_cast<std::size_t>(a)][lane] = d.normal[a];
  }
  pack.radius[lane] = d.radius;
}

template <class Pack>
void fill(Pack& pack, const AccelInput& input, const BuildRef* refs, std::uint32_t count) {
  pack = Pack::unused();
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    pack.primitive[lane] = refs[lane].index();
    set_lane(pack, lane, input, pack.primitive[lane]);
  }
}

void fill_pack(AccelTree& tree, const AccelInput& input, const HugeVector<BuildRef>& refs,
               const LeafRange& leaf) {
  const BuildRef* first = refs.data() + leaf.begin;
  switch (leaf.kind) {
  case LeafKind::triangles: return fill(tree.triangles[leaf.pack], input, first, leaf.count);
  case LeafKind::spheres: return fill(tree.spheres[leaf.pack], input, first, leaf.count);
  case LeafKind::discs: return fill(tree.discs[leaf.pack], input, first, leaf.count);
  case LeafKind::instance: tree.instances[leaf.pack] = make_instance(input, first->index());
  }
}

/// Within a team of threads, to which the stages give tasks.
std::unique_ptr<AccelTree> build_tree(const AccelInput& input, std::size_t count, BuildQuality quality,
                                      Progress* progress) {
  const BuildStage making_refs(progress, StageWork::refs), filling_packs(progress, StageWork::packs);
  making_refs.check();
  auto tree = std::make_unique<AccelTree>();
  AccelStats& stats = tree->stats;
  RefList list;
  list.refs.reserve(quality == BuildQuality::high ? with_doubles(count) : count);
  stats.triangles = list.append(
      LeafKind::triangles, input.triangles.size(), [&](std::size_t i) { return triangle_bounds(input, i); },
      making_refs);
  stats.spheres = list.append(
      LeafKind::spheres, input.spheres.size(), [&](std::size_t i) { return sphere_bounds(input, i); },
      making_refs);
  stats.discs = list.append(
      LeafKind::discs, input.discs.size(), [&](std::size_t i) { return disc_bounds(input, i); }, making_refs);
  stats.instances = list.append(
      LeafKind::instance, input.instances.size(), [&](std::size_t i) { return instance_bounds(input, i); },
      making_refs);
  const std::size_t used = list.refs.size();
  stats.skipped = count - used;
  stats.bytes = sizeof(AccelTree);
  making_refs.done(used);
  if (progress) progress->advance(Accel::build_work(stats.skipped));
  if (used == 0) return tree;

  const BinaryBvh binary = build_binary_bvh(input, std::move(list.refs), list.bounds,
                                            !std::has_single_bit(list.kinds), quality, progress);
  WideBvh wide = collapse(binary, quality, progress);
  tree->root = wide.root;
  tree->lower = list.bounds.box.lo(), tree->upper = list.bounds.box.hi();
  for (int a = 0; a < 3; ++a) tree->bounds.lo[a] = tree->lower[a], tree->bounds.hi[a] = tree->upper[a];
  tree->nodes = std::move(wide.nodes);
  tree->triangles.resize(wide.packs[static_cast<std::size_t>(LeafKind::triangles)]);
  tree->spheres.resize(wide.packs[static_cast<std::size_t>(LeafKind::spheres)]);
  tree->discs.resize(wide.packs[static_cast<std::size_t>(LeafKind::discs)]);
  tree->instances.resize(wide.packs[static_cast<std::size_t>(LeafKind::instance)]);
  constexpr std::size_t kLeavesPerTask = 512;
  std::atomic<bool> given_up{false};
#pragma omp taskloop default(shared) num_tasks(kLoopTasks)
  for (std::size_t first = 0; first < wide.leaves.size(); first += kLeavesPerTask) {
    if (filling_packs.cancelled()) {
      given_up = true;
      continue;
    }
    std::size_t primitives = 0;
    for (std::size_t i = first; i < std::min(first + kLeavesPerTask, wide.leaves.size()); ++i) {
      fill_pack(*tree, input, binary.refs, wide.leaves[i]);
      primitives += wide.leaves[i].count;
    }
    filling_packs.done(primitives);
  }
  if (given_up) throw Cancelled();

  stats.nodes = tree->nodes.size();
  stats.leaves = wide.leaves.size();
  stats.depth = wide.depth;
  stats.sah_cost = wide.sah_cost;
  stats.bytes += tree->nodes.size() * sizeof(WideNode) + tree->triangles.size() * sizeof(TrianglePack) +
                 tree->spheres.size() * sizeof(SpherePack) + tree->discs.size() * sizeof(DiscPack) +
                 tree->instances.size() * sizeof(InstanceRecord);
  return tree;
}

} // namespace

Accel::Accel() = default;
Accel::~Accel() = default;
Accel::Accel(Accel&&) noexcept = default;
Accel& Accel::operator=(Accel&&) noexcept = default;
Accel::Accel(std::unique_ptr<const AccelTree> tree) : tree_(std::move(tree)) {}

std::uint64_t Accel::build_work(std::size_t primitives) { return kWorkPerPrimitive * primitives; }

Accel Accel::build(const AccelInput& input, BuildQuality quality, Progress* progress) {
  std::size_t count =
      input.triangles.size() + input.spheres.size() + input.discs.size() + input.instances.size();
  if (count > kMaxPrimitives)
    throw limit_error({}, "scene", "more than 2^28 primitives", "use fewer, or instances");
  for (const InstanceGeometry& instance : input.instances)
    if (instance.object && instance.object->stats().instances)
      throw limit_error({}, "instance", "its object holds instances itself", "flatten the hierarchy");

  // One team for all stages rather than one each: at the end of its work a team waits for the slowest of its
  // threads, and where others use the machine that may be one that does not run at all. Tasks are taken by
  // those that do.
  std::unique_ptr<AccelTree> tree;
  std::exception_ptr error;
#pragma omp parallel if (count >= kTeamWork)
#pragma omp single
  try {
    tree = build_tree(input, count, quality, progress);
  } catch (...) { // no exception may leave the region
    error = std::current_exception();
  }
  if (error) std::rethrow_exception(error);
  return Accel(std::move(tree));
}

Bounds3 Accel::bounds() const { return tree_ ? tree_->bounds : Bounds3{}; }
std::size_t Accel::memory_bytes() const { return stats().bytes; }
AccelStats Accel::stats() const { return tree_ ? tree_->stats : AccelStats{}; }

} // namespace candela
