#pragma once
// The binary tree that the wide one is made from: a top-down build that splits where the surface area
// heuristic over bins of centroids is least (Wald 2007, "On fast Construction of SAH-based Bounding Volume
// Hierarchies").

#include "accel/accel.h"
#include "accel/layout.h"
#include "core/progress.h"

#include <memory>
#include <vector>

namespace candela::accel_detail {

/// A primitive as the builder sees it: a box and what to call it.
struct alignas(32) BuildRef {
  std::array<float, 3> lo;
  std::uint32_t index; ///< into the input array of its kind
  std::array<float, 3> hi;
  LeafKind kind;
};

/// A node over refs [begin, begin + count). Nodes lie in preorder with room for all the nodes that the range
/// could need: the left child of node i is i + 1, the right one i + 2 * (count of the left one). So the place
/// of a node depends on the input alone, and threads that build subtrees need not agree on anything.
struct alignas(32) BinaryNode {
  std::array<float, 3> lo;
  std::uint32_t begin;
  std::array<float, 3> hi;
  std::uint32_t count : 28;
  std::uint32_t leaf : 1;
  std::uint32_t mixed : 1; ///< more than one kind of primitive

  float half_area() const {
    float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
  }
};

inline constexpr std::size_t kMaxPrimitives = (std::size_t{1} << 28) - 1;

struct BinaryBvh {
  std::unique_ptr<BinaryNode[]> nodes; ///< sparse, see above; nodes[0] is the root
  std::vector<BuildRef> refs;          ///< reordered

  std::uint32_t left(std::uint32_t node) const { return node + 1; }
  std::uint32_t right(std::uint32_t node) const { return node + 2 * nodes[node + 1].count; }
};

/// refs is not empty and its boxes are finite. high builds down to single primitives, fast stops at what fits
/// a pack. Throws Cancelled.
BinaryBvh build_binary_bvh(std::vector<BuildRef> refs, BuildQuality quality, Progress* progress = nullptr);

/// The most primitives of a kind that a leaf holds.
constexpr std::uint32_t leaf_capacity(LeafKind kind) {
  return kind == LeafKind::instance ? 1 : static_cast<std::uint32_t>(kWidth);
}

} // namespace candela::accel_detail
