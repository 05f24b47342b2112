#pragma once
// Which binary nodes become wide nodes and leaves: chosen bottom-up by dynamic programming so that the
// surface area heuristic of the wide tree is least (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray
// Traversal on GPUs Through Compressed Wide BVHs", section 3.1). The builder does it while it returns from
// the children, whose costs are then at hand and never stored.
//
// cost(n, 1) = min(leaf(n), area(n) * kNodeCost + split(n, 8))
// cost(n, i) = min(split(n, i), cost(n, i - 1))             for 1 < i < 8
// split(n, i) = min over 0 < k < i of cost(left, k) + cost(right, i - k)

#include "accel/binary_bvh.h"

namespace candela::accel_detail {

/// Costs in node visits. What a pack costs matters little: from 0.5 to 4 the rays per second differ by 2 %.
inline constexpr float kNodeCost = 1.0f;
constexpr float leaf_cost(PrimitiveKind kind) { return PrimitiveKinds::kLeafCost[number(kind)]; }
/// What a pack costs for the memory that it takes, visited or not: as if its area were greater by so many
/// times that of the root, divided by the number of primitives. Rarely visited packs are filled; the expected
/// cost grows by less than 0.3 %, and bytes per triangle shrink from 65 to 57 (Sponza), from 61 to 50 (bunny)
/// and from 59 to 53 (sphere). At 8 all is full, but the Cornell box's packs are few and large.
inline constexpr float kPackMemoryCost = 4;

/// [i]: the cost of a forest of at most i trees, i in 1..7; [0] is infinite.
using ForestCosts = std::array<float, kWidth>;

/// What becomes of a node. Four bits for each number of slots i from 2 to 8, at 4 (i - 1): how many of them
/// the left child gets; 0 (for i < 8) means that one slot less is no worse. Bit 0: whether it is a leaf when
/// it has a slot to itself.
struct CollapsePlan {
  std::uint32_t bits;

  static CollapsePlan leaf() { return {1}; }
  bool is_leaf() const { return bits & 1; }
  int left_slots(int slots) const { return static_cast<int>(bits >> 4 * (slots - 1) & 15); }
};

/// `leaf` is the cost of the node as a leaf, infinite if it cannot be one.
inline CollapsePlan plan_node(float half_area, float leaf, const ForestCosts& left, const ForestCosts& right,
                              ForestCosts& cost) {
  CollapsePlan plan{0};
  auto split = [&](std::size_t slots) {
    float best = left[1] + right[slots - 1];
    std::uint32_t left_slots = 1;
    for (std::uint32_t k = 2; k < slots; ++k) {
      float c = left[k] + right[slots - k];
      left_slots = c < best ? k : left_slots;
      best = c < best ? c : best;
    }
    return std::pair(best, left_slots);
  };
  auto [all, all_left] = split(kWidth);
  plan.bits = all_left << 4 * (kWidth - 1);
  float inner = half_area * kNodeCost + all;
  if (leaf <= inner) plan.bits |= 1;
  cost[0] = kInfinity;
  cost[1] = std::min(leaf, inner);
  for (std::size_t slots = 2; slots < kWidth; ++slots) {
    auto [c, left_slots] = split(slots);
    bool better = c < cost[slots - 1];
    cost[slots] = better ? c : cost[slots - 1];
    plan.bits |= (better ? left_slots : 0) << 4 * (slots - 1);
  }
  return plan;
}

} // namespace candela::accel_detail
