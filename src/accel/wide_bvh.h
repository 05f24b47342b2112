#pragma once
// Turns the binary tree into nodes of eight children and leaves that are one pack each.

#include "accel/binary_bvh.h"

#include <vector>

namespace candela::accel_detail {

/// A leaf to fill: which refs make up the pack.
struct LeafRange {
  PrimitiveKind kind;
  std::uint32_t pack; ///< index among those of its kind
  std::uint32_t begin, count;
};

struct WideBvh {
  ChildRef root;
  HugeVector<WideNode> nodes; ///< in preorder
  HugeVector<LeafRange> leaves;
  PerKind<std::uint32_t> packs{}; ///< how many of each kind
  int depth = 0;
  double sah_cost = 0;
};

/// Throws Error (ExitCode::limit) where a ChildRef could not name all packs of a kind.
void require_addressable(const PerKind<std::uint32_t>& packs);

/// By the plan of a high build; a fast one has none, and always the child of largest area is opened. Throws
/// Cancelled.
WideBvh collapse(const BinaryBvh& bvh, BuildQuality quality, Progress* progress = nullptr);

} // namespace candela::accel_detail
