#pragma once
// What lies in memory while rays are traced: nodes of eight boxes and packs of up to eight primitives, each
// field as eight floats side by side, so that one SIMD instruction treats all of them.

#include "accel/accel.h"
#include "accel/huge_pages.h"
#include "accel/simd.h"

#include <array>
#include <bit>
#include <vector>

namespace candela {

inline constexpr int kWidth = simd::kLanes;

enum class LeafKind : std::uint32_t { triangles, spheres, discs, instance };

/// A node or a leaf: bit 31 tells which, bits 29 and 30 the leaf's kind, the others index the node, pack or
/// instance. A leaf is exactly one pack, so it needs no count.
struct ChildRef {
  static constexpr std::uint32_t kLeafBit = 1u << 31;
  static constexpr std::uint32_t kIndexMask = (1u << 29) - 1;
  std::uint32_t bits; // no initialiser: a traversal stack of these must cost nothing

  static constexpr ChildRef node(std::uint32_t index) { return {index}; }
  static constexpr ChildRef leaf(LeafKind kind, std::uint32_t index) {
    return {kLeafBit | static_cast<std::uint32_t>(kind) << 29 | index};
  }
  constexpr bool is_leaf() const { return bits & kLeafBit; }
  constexpr LeafKind kind() const { return static_cast<LeafKind>(bits >> 29 & 3); }
  constexpr std::uint32_t index() const { return bits & kIndexMask; }
  bool operator==(const ChildRef&) const = default;
};

/// Boxes of eight children: box[axis][0] their lower and box[axis][1] their upper planes. Unused slots hold
/// an empty box, which no ray meets.
struct alignas(64) WideNode {
  std::array<std::array<std::array<float, kWidth>, 2>, 3> box;
  std::array<ChildRef, kWidth> child;
  bool operator==(const WideNode&) const = default;
};

/// Coordinates of eight primitives that no ray meets: products and differences of them are NaN. So lanes in
/// use need no mask, and no primitive is in several lanes of a pack.
inline constexpr std::array<float, kWidth> kNowhere{kInfinity, kInfinity, kInfinity, kInfinity,
                                                    kInfinity, kInfinity, kInfinity, kInfinity};

/// vertex[k][axis] of eight triangles.
struct alignas(64) TrianglePack {
  std::array<std::array<std::array<float, kWidth>, 3>, 3> vertex;
  std::array<std::uint32_t, kWidth> primitive;

  static TrianglePack unused() {
    constexpr std::array<std::array<float, kWidth>, 3> kVertex{kNowhere, kNowhere, kNowhere};
    return {{kVertex, kVertex, kVertex}, {}};
  }
  bool operator==(const TrianglePack&) const = default;
};

struct alignas(32) SpherePack {
  std::array<std::array<float, kWidth>, 3> center;
  std::array<float, kWidth> radius;
  std::array<std::uint32_t, kWidth> primitive;

  static SpherePack unused() { return {{kNowhere, kNowhere, kNowhere}, {}, {}}; }
  bool operator==(const SpherePack&) const = default;
};

struct alignas(32) DiscPack {
  std::array<std::array<float, kWidth>, 3> center, normal;
  std::array<float, kWidth> radius;
  std::array<std::uint32_t, kWidth> primitive;

  static DiscPack unused() { return {{kNowhere, kNowhere, kNowhere}, {}, {}, {}}; }
  bool operator==(const DiscPack&) const = default;
};

struct InstanceRecord {
  const AccelTree* object;
  glm::mat4x3 object_from_world;
  std::uint32_t index; ///< into AccelInput::instances
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
  HugeVector<TrianglePack> triangles;
  HugeVector<SpherePack> spheres;
  HugeVector<DiscPack> discs;
  std::vector<InstanceRecord> instances;
  AccelStats stats;

  bool empty() const { return stats.leaves == 0; }
};

/// For the parts of accel/ (and its tests) that trace trees themselves.
struct AccelAccess {
  static const AccelTree* tree(const Accel& accel) { return accel.tree_.get(); }
};

} // namespace candela
