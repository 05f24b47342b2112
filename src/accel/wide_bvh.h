#pragma once
// Turns the binary tree into nodes of eight children and leaves that are one pack each.

#include "accel/binary_bvh.h"
#include "accel/build_stage.h"

#include <vector>

namespace candela::accel_detail {

/// Costs in node visits. What a pack costs matters little: from 0.6 to 2.5 the rays per second differ by 2 %.
inline constexpr float kNodeCost = 1.0f;
constexpr float leaf_cost(LeafKind kind) { return kind == LeafKind::instance ? 8.0f : 1.5f; }

/// What becomes of each binary node, chosen bottom-up by dynamic programming so that the surface area
/// heuristic of the wide tree is least (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on
/// GPUs Through Compressed Wide BVHs", section 3.1), or greedily: always open the child of largest area.
class CollapsePlan {
public:
  CollapsePlan(const BinaryBvh& bvh, BuildQuality quality, const BuildStage& stage);

  bool is_leaf(std::uint32_t node) const;
  /// The binary nodes that become the children of the wide node made from this one; gives how many.
  int children(std::uint32_t node, std::array<std::uint32_t, kWidth>& result) const;

private:
  using Costs = std::array<float, kWidth>; ///< [i]: of a forest of at most i trees, i in 1..7
  Costs plan(std::uint32_t node);
  Costs plan_subtree(std::uint32_t node);
  void distribute(std::uint32_t node, int slots, std::array<std::uint32_t, kWidth>& result, int& count) const;
  void open_largest(std::uint32_t node, std::array<std::uint32_t, kWidth>& result, int& count) const;

  const BinaryBvh& bvh_;
  const BuildStage& stage_;
  /// Four bits for each number of slots i: how many of them the left child gets; 0 (for i < 8) means that one
  /// slot less is no worse. Bits 0 to 3: whether the node is a leaf when it has a slot to itself.
  std::unique_ptr<std::uint32_t[]> decisions_;
};

/// A leaf to fill: which refs make up the pack.
struct LeafRange {
  LeafKind kind;
  std::uint32_t pack; ///< index among those of its kind
  std::uint32_t begin, count;
};

struct WideBvh {
  ChildRef root;
  HugeVector<WideNode> nodes; ///< in preorder
  std::vector<LeafRange> leaves;
  std::array<std::uint32_t, 4> packs{}; ///< how many of each LeafKind
  int depth = 0;
  double sah_cost = 0;
};

/// Throws Cancelled.
WideBvh collapse(const BinaryBvh& bvh, BuildQuality quality, Progress* progress = nullptr);

} // namespace candela::accel_detail
