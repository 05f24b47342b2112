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
constexpr std::size_t kParallelWork = 4096;

/// Refs of the primitives that can be hit.
struct RefList {
  HugeVector<BuildRef> refs;
  RangeBounds bounds;
  std::uint32_t kinds = 0;

  /// Appends a ref for every primitive of a kind that can be hit; gives how many.
  template <class BoundsOf>
  std::size_t append(PrimitiveKind kind, std::size_t count, BoundsOf bounds_of, const BuildStage& stage) {
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

void fill_leaf(AccelTree& tree, const AccelInput& input, const HugeVector<BuildRef>& refs,
               const LeafRange& leaf) {
  std::array<std::uint32_t, kWidth> primitives;
  for (std::uint32_t i = 0; i < leaf.count; ++i) primitives[i] = refs[leaf.begin + i].index();
  PrimitiveKinds::visit(leaf.kind, [&]<class Kind>() {
    static_assert(Kind::kLeafCapacity <= kWidth);
    Kind::fill(tree.packs<Kind>()[leaf.pack], input, {primitives.data(), leaf.count});
    return true;
  });
}

/// Within a parallel region, to which the stages give tasks.
std::unique_ptr<AccelTree> build_tree(const AccelInput& input, std::size_t count, BuildQuality quality,
                                      Progress* progress) {
  const BuildStage making_refs(progress, StageWork::refs), filling_packs(progress, StageWork::packs);
  making_refs.check();
  auto tree = std::make_unique<AccelTree>();
  AccelStats& stats = tree->stats;
  RefList list;
  list.refs.reserve(quality == BuildQuality::high ? with_doubles(count) : count);
  PrimitiveKinds::for_each([&]<class Kind>() {
    constexpr PrimitiveKind kKind = PrimitiveKinds::kind_of<Kind>;
    stats.primitives[number(kKind)] = list.append(
        kKind, Kind::count(input), [&](std::size_t i) { return Kind::bounds(input, i); }, making_refs);
  });
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
  PrimitiveKinds::for_each(
      [&]<class Kind>() { tree->packs<Kind>().resize(wide.packs[number(PrimitiveKinds::kind_of<Kind>)]); });
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
      fill_leaf(*tree, input, binary.refs, wide.leaves[i]);
      primitives += wide.leaves[i].count;
    }
    filling_packs.done(primitives);
  }
  if (given_up) throw Cancelled();

  stats.nodes = tree->nodes.size();
  stats.leaves = wide.leaves.size();
  stats.depth = wide.depth;
  stats.sah_cost = wide.sah_cost;
  stats.bytes += tree->nodes.size() * sizeof(WideNode);
  PrimitiveKinds::for_each(
      [&]<class Kind>() { stats.bytes += tree->packs<Kind>().size() * sizeof(typename Kind::Pack); });
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
  std::size_t count = 0;
  PrimitiveKinds::for_each([&]<class Kind>() { count += Kind::count(input); });
  if (count > kMaxPrimitives)
    throw limit_error({}, "scene", "more than 2^28 primitives", "use fewer, or instances");
  auto refuse_nested = [](const auto& instances) {
    for (const auto& instance : instances)
      if (instance.object && (instance.object->stats().count(PrimitiveKind::instance) > 0 ||
                              instance.object->stats().count(PrimitiveKind::moving_instance) > 0))
        throw limit_error({}, "instance", "its object holds instances itself", "flatten the hierarchy");
  };
  refuse_nested(input.instances);
  refuse_nested(input.moving_instances);

  // One group of threads for all stages rather than one each: at the end of its work the group waits for the
  // slowest of its threads, and where others use the machine that may be one that does not run at all. Tasks
  // are taken by those that do.
  std::unique_ptr<AccelTree> tree;
  std::exception_ptr error;
#pragma omp parallel if (count >= kParallelWork)
#pragma omp single
  try {
    tree = build_tree(input, count, quality, progress);
  } catch (...) { // no exception may leave the region
    error = std::current_exception();
  }
  if (error) std::rethrow_exception(error);
  return Accel(std::move(tree));
}

Bounds3 accel_detail::object_bounds(const Accel& object) { return object.bounds(); }
const AccelTree* accel_detail::object_tree(const Accel& object) { return AccelAccess::tree(object); }

Bounds3 Accel::bounds() const { return tree_ ? tree_->bounds : Bounds3{}; }
std::size_t Accel::memory_bytes() const { return stats().bytes; }
AccelStats Accel::stats() const { return tree_ ? tree_->stats : AccelStats{}; }

} // namespace candela
