#include "accel/wide_bvh.h"

#include <algorithm>

namespace candela::accel_detail {

namespace {

constexpr std::uint32_t kTaskRange = 4096;

bool fits_leaf(const BinaryBvh& bvh, const BinaryNode& node) {
  return !node.mixed && node.count <= leaf_capacity(bvh.refs[node.begin].kind);
}

} // namespace

CollapsePlan::CollapsePlan(const BinaryBvh& bvh, BuildQuality quality, const BuildStage& stage)
    : bvh_(bvh), stage_(stage) {
  if (quality == BuildQuality::fast) {
    stage_.done(bvh.refs.size());
    return;
  }
  decisions_ = std::make_unique_for_overwrite<std::uint32_t[]>(2 * bvh.refs.size() - 1);
#pragma omp parallel if (bvh.refs.size() >= kTaskRange)
#pragma omp single
  plan_subtree(0);
  stage_.check();
}

/// One that may be a task of its own. Cancelled, it decides nothing.
CollapsePlan::Costs CollapsePlan::plan_subtree(std::uint32_t node) {
  if (stage_.cancelled()) return {};
  const Costs costs = plan(node);
  if (std::uint32_t count = bvh_.nodes[node].count; count < kTaskRange) stage_.done(count);
  return costs;
}

bool CollapsePlan::is_leaf(std::uint32_t node) const {
  return bvh_.nodes[node].leaf || (decisions_ && decisions_[node] & 1);
}

// cost(n, 1) = min(leaf(n), area(n) * kNodeCost + split(n, 8))
// cost(n, i) = min(split(n, i), cost(n, i - 1))             for 1 < i < 8
// split(n, i) = min over 0 < k < i of cost(left, k) + cost(right, i - k)
CollapsePlan::Costs CollapsePlan::plan(std::uint32_t index) {
  const BinaryNode& node = bvh_.nodes[index];
  float leaf = fits_leaf(bvh_, node) ? node.half_area() * leaf_cost(bvh_.refs[node.begin].kind) : kInfinity;
  Costs cost;
  if (node.leaf) {
    decisions_[index] = 1;
    cost.fill(leaf);
    return cost;
  }
  std::uint32_t left_index = bvh_.left(index), right_index = bvh_.right(index);
  Costs left, right;
  if (node.count >= kTaskRange) {
#pragma omp task default(shared) firstprivate(left_index)
    left = plan_subtree(left_index);
    right = plan_subtree(right_index);
#pragma omp taskwait
  } else {
    left = plan(left_index), right = plan(right_index);
  }

  std::uint32_t decision = 0;
  auto split = [&](std::size_t slots) {
    float best = left[1] + right[slots - 1];
    std::size_t left_slots = 1;
    for (std::size_t k = 2; k < slots; ++k)
      if (float c = left[k] + right[slots - k]; c < best) best = c, left_slots = k;
    return std::pair(best, static_cast<std::uint32_t>(left_slots));
  };
  // The nibble for eight slots is the top one, at 4 * 7: the one for a single slot is the leaf bit.
  auto [all, all_left] = split(kWidth);
  decision |= all_left << 4 * (kWidth - 1);
  float inner = node.half_area() * kNodeCost + all;
  if (leaf <= inner) decision |= 1;
  cost[0] = 0;
  cost[1] = std::min(leaf, inner);
  for (std::size_t slots = 2; slots < kWidth; ++slots) {
    auto [c, left_slots] = split(slots);
    cost[slots] = std::min(c, cost[slots - 1]);
    if (c < cost[slots - 1]) decision |= left_slots << 4 * (slots - 1);
  }
  decisions_[index] = decision;
  return cost;
}

void CollapsePlan::distribute(std::uint32_t node, int slots, std::array<std::uint32_t, kWidth>& result,
                              int& count) const {
  int left_slots = 0;
  while (slots > 1) {
    left_slots = static_cast<int>(decisions_[node] >> 4 * (slots - 1) & 15);
    if (left_slots) break;
    --slots;
  }
  if (slots == 1) {
    result[static_cast<std::size_t>(count++)] = node;
    return;
  }
  distribute(bvh_.left(node), left_slots, result, count);
  distribute(bvh_.right(node), slots - left_slots, result, count);
}

void CollapsePlan::open_largest(std::uint32_t node, std::array<std::uint32_t, kWidth>& result,
                                int& count) const {
  result[0] = bvh_.left(node), result[1] = bvh_.right(node);
  count = 2;
  while (count < kWidth) {
    int widest = -1;
    float area = -1;
    for (int i = 0; i < count; ++i) {
      const BinaryNode& child = bvh_.nodes[result[static_cast<std::size_t>(i)]];
      if (!child.leaf && child.half_area() > area) widest = i, area = child.half_area();
    }
    if (widest < 0) break;
    std::uint32_t opened = result[static_cast<std::size_t>(widest)];
    result[static_cast<std::size_t>(widest)] = bvh_.left(opened);
    result[static_cast<std::size_t>(count++)] = bvh_.right(opened);
  }
}

int CollapsePlan::children(std::uint32_t node, std::array<std::uint32_t, kWidth>& result) const {
  int count = 0;
  if (decisions_) {
    int left_slots = static_cast<int>(decisions_[node] >> 4 * (kWidth - 1));
    distribute(bvh_.left(node), left_slots, result, count);
    distribute(bvh_.right(node), kWidth - left_slots, result, count);
  } else {
    open_largest(node, result, count);
  }
  return count;
}

namespace {

class Emitter {
public:
  Emitter(const BinaryBvh& bvh, const CollapsePlan& plan, WideBvh& wide, const BuildStage& stage)
      : bvh_(bvh), plan_(plan), wide_(wide), stage_(stage) {}

  /// The whole tree.
  ChildRef emit() {
    const ChildRef root = emit(0, 1);
    if (bvh_.nodes[0].count < kTaskRange) stage_.done(bvh_.nodes[0].count);
    return root;
  }

private:
  ChildRef emit(std::uint32_t node, int depth) {
    if (plan_.is_leaf(node)) return emit_leaf(bvh_.nodes[node]);
    wide_.depth = std::max(wide_.depth, depth);
    wide_.sah_cost += bvh_.nodes[node].half_area() * kNodeCost;
    auto index = static_cast<std::uint32_t>(wide_.nodes.size());
    WideNode empty;
    for (auto& axis : empty.box) axis[0].fill(kInfinity), axis[1].fill(-kInfinity);
    wide_.nodes.push_back(empty);
    const bool large = bvh_.nodes[node].count >= kTaskRange;
    if (large) stage_.check();
    std::array<std::uint32_t, kWidth> children;
    auto count = static_cast<std::size_t>(plan_.children(node, children));
    for (std::size_t i = 0; i < count; ++i) {
      const BinaryNode& child = bvh_.nodes[children[i]];
      for (std::size_t a = 0; a < 3; ++a) {
        wide_.nodes[index].box[a][0][i] = child.lo[a];
        wide_.nodes[index].box[a][1][i] = child.hi[a];
      }
      ChildRef ref = emit(children[i], depth + 1);
      wide_.nodes[index].child[i] = ref; // not before: the vector may have moved
      if (large && child.count < kTaskRange) stage_.done(child.count);
    }
    // No ray meets an empty slot, but one of nonsense (NaN) must find a child there all the same.
    for (std::size_t i = count; i < kWidth; ++i) wide_.nodes[index].child[i] = wide_.nodes[index].child[0];
    return ChildRef::node(index);
  }

  ChildRef emit_leaf(const BinaryNode& node) {
    LeafKind kind = bvh_.refs[node.begin].kind;
    std::uint32_t pack = wide_.packs[static_cast<std::size_t>(kind)]++;
    wide_.leaves.push_back({kind, pack, node.begin, node.count});
    wide_.sah_cost += node.half_area() * leaf_cost(kind);
    return ChildRef::leaf(kind, pack);
  }

  const BinaryBvh& bvh_;
  const CollapsePlan& plan_;
  WideBvh& wide_;
  const BuildStage& stage_;
};

} // namespace

WideBvh collapse(const BinaryBvh& bvh, BuildQuality quality, Progress* progress) {
  WideBvh wide;
  const BuildStage planning(progress, StageWork::plan), emitting(progress, StageWork::emit);
  CollapsePlan plan(bvh, quality, planning);
  wide.root = Emitter(bvh, plan, wide, emitting).emit();
  if (float area = bvh.nodes[0].half_area(); area > 0) wide.sah_cost /= area;
  wide.nodes.shrink_to_fit();
  return wide;
}

} // namespace candela::accel_detail
