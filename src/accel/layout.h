#pragma once
// What lies in memory while rays are traced: nodes of eight boxes, and the packs of each primitive kind.

#include "accel/accel.h"
#include "accel/huge_pages.h"
#include "accel/simd/simd.h"

#include <array>
#include <bit>
#include <vector>

namespace candela {

/// A node or a leaf. Bit 31 tells which; a node's other bits are its index. A leaf has its kind in bits 27 to
/// 30 and the index of its pack among those of that kind below. A leaf is exactly one pack, so it needs no
/// count.
///
/// So there is room for 16 kinds, and for 2^27 packs of each (a build of more is refused): 43 GB of
/// triangles. A kind in the pack's header, or in a table by pack, would lift that limit, but has to be loaded
/// before the traversal knows what to do with the leaf.
struct ChildRef {
  static constexpr std::uint32_t kLeafBit = 1u << 31;
  static constexpr int kPackBits = 27;
  static constexpr std::uint32_t kMaxPacks = 1u << kPackBits;
  std::uint32_t bits; // no initialiser: a traversal stack of these must cost nothing

  static constexpr ChildRef node(std::uint32_t index) { return {index}; }
  static constexpr ChildRef leaf(PrimitiveKind kind, std::uint32_t pack) {
    return {kLeafBit | static_cast<std::uint32_t>(kind) << kPackBits | pack};
  }
  constexpr bool is_leaf() const { return bits & kLeafBit; }
  /// Of a leaf.
  constexpr PrimitiveKind kind() const { return static_cast<PrimitiveKind>(bits >> kPackBits & 15); }
  constexpr std::uint32_t pack() const { return bits & (kMaxPacks - 1); }
  /// Of a node.
  constexpr std::uint32_t node() const { return bits; }
  bool operator==(const ChildRef&) const = default;
};
static_assert(accel_detail::PrimitiveKinds::kCount <= 16);

/// Boxes of eight children: box[axis][0] their lower and box[axis][1] their upper planes. Unused slots hold
/// an empty box, which no ray hits.
struct alignas(64) WideNode {
  std::array<std::array<std::array<float, kWidth>, 2>, 3> box;
  std::array<ChildRef, kWidth> child;
  bool operator==(const WideNode&) const = default;
};

/// The builder keeps every way from the root to a leaf shorter than this.
inline constexpr int kMaxDepth = 62;
/// Where a ray of a packet may begin, at most. At 8, rays in Sponza take 1.2 to 1.6 times as long; at 24,
/// what is 5 % faster in Sponza is 5 % slower on the sphere.
inline constexpr int kMaxEntryPoints = 16;
/// A visited node leaves at most seven children waiting; eight are written at once.
inline constexpr int kStackSize = kMaxEntryPoints + (kWidth - 1) * kMaxDepth + kWidth;

struct AccelTree {
  simd::Vec4 lower{}, upper{}; ///< of the bounds, with a lane to spare
  ChildRef root{};
  Bounds3 bounds;
  HugeVector<WideNode> nodes;
  accel_detail::PrimitiveKinds::Storage<HugeVector> storage; ///< packs of each kind
  AccelStats stats;

  template <class Kind>
  const HugeVector<typename Kind::Pack>& packs() const {
    return std::get<accel_detail::number(accel_detail::PrimitiveKinds::kind_of<Kind>)>(storage);
  }
  template <class Kind>
  HugeVector<typename Kind::Pack>& packs() {
    return std::get<accel_detail::number(accel_detail::PrimitiveKinds::kind_of<Kind>)>(storage);
  }
  const HugeVector<TrianglePack>& triangles() const { return packs<primitives::Triangles>(); }
  bool empty() const { return stats.leaves == 0; }
};

/// For the parts of accel/ (and its tests) that trace trees themselves.
struct AccelAccess {
  static const AccelTree* tree(const Accel& accel) { return accel.tree_.get(); }
};

} // namespace candela
