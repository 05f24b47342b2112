#pragma once
// The binary tree that the wide one is made from: a top-down build that splits where the surface area
// heuristic over bins of centroids is least (Wald 2007, "On fast Construction of SAH-based Bounding Volume
// Hierarchies").
//
// At high quality triangles that reach across a split are referenced on both sides where that is worth it
// (accel/spatial_split.h): in Sponza primary rays are 1.15 and diffuse ones 1.18 times as fast, for 6 % more
// refs. Cutting large triangles up beforehand (Karras and Aila 2013, "Fast Parallel Construction of
// High-Quality Bounding Volume Hierarchies", section 4.3) was tried instead and made Sponza slower: walls and
// floors, few packs that every ray tests near the root, came to lie among small things.

#include "accel/accel.h"
#include "accel/huge_pages.h"
#include "accel/layout.h"
#include "core/progress.h"

namespace candela::accel_detail {

/// A box as one vector of eight floats, x y z of the lower corner, a lane to spare, x y z of the *negated*
/// upper corner, a lane to spare: to grow it is one minimum instead of a minimum and a maximum.
struct BuildBox {
  simd::Float8 v{kInfinity};

  void grow(simd::Float8 box) { v = min(box, v); }
  void grow(const BuildBox& box) { grow(box.v); }
  simd::Vec4 lo() const { return v.lower(); }
  simd::Vec4 hi() const { return -v.upper(); }
  /// Products of two extents at a time, so it does not matter that these are negated.
  float half_area() const {
    simd::Vec4 d = v.lower() + v.upper();
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

/// A primitive as the builder sees it: a box (as in BuildBox) and, in the lanes to spare, what to call it.
/// There a bit makes normal floats of all numbers: arithmetic with denormal ones, which small integers look
/// like, is slow.
struct alignas(32) BuildRef {
  std::array<float, 3> lo;
  std::uint32_t tagged_index;
  std::array<float, 3> negated_hi;
  std::uint32_t tagged_kind;

  static constexpr std::uint32_t kTag = 1u << 30;
  static BuildRef make(const Bounds3& b, std::uint32_t index, PrimitiveKind kind) {
    return {{b.lo.x, b.lo.y, b.lo.z},
            index | kTag,
            {-b.hi.x, -b.hi.y, -b.hi.z},
            static_cast<std::uint32_t>(kind) | kTag};
  }
  std::uint32_t index() const { return tagged_index & ~kTag; } ///< into the input array of its kind
  PrimitiveKind kind() const { return static_cast<PrimitiveKind>(tagged_kind & ~kTag); }
  simd::Float8 box() const { return simd::Float8::load(lo.data()); }
  /// The part of it in a box.
  BuildRef within(const BuildBox& b) const {
    BuildRef part = *this;
    const simd::Vec4 l = b.v.lower(), h = b.v.upper();
    for (int a = 0; a < 3; ++a)
      part.lo[static_cast<std::size_t>(a)] = l[a], part.negated_hi[static_cast<std::size_t>(a)] = h[a];
    return part;
  }
};

/// The sum of the corners of a ref's box, twice its centroid.
inline simd::Vec4 twice_centroid(simd::Float8 box) { return box.lower() - box.upper(); }

struct CentroidBounds {
  simd::Vec4 lo{kInfinity, kInfinity, kInfinity, kInfinity}, hi = -lo; ///< of twice the centroids

  /// Unless c is NaN.
  void grow(simd::Vec4 c) { lo = simd::min4(c, lo), hi = simd::max4(c, hi); }
  void merge(const CentroidBounds& b) { lo = simd::min4(b.lo, lo), hi = simd::max4(b.hi, hi); }
};

/// Of a range of refs.
struct RangeBounds {
  BuildBox box;
  CentroidBounds centroids;

  void grow(const BuildRef& ref) {
    simd::Float8 b = ref.box();
    box.grow(b);
    centroids.grow(twice_centroid(b));
  }
  void merge(const RangeBounds& b) { box.grow(b.box), centroids.merge(b.centroids); }
};

/// An inner node.
struct alignas(32) BinaryNode {
  std::array<float, 3> lo;
  std::uint32_t plan; ///< what the wide tree makes of it, see CollapsePlan
  std::array<float, 3> negated_hi;
  std::uint32_t left_count; ///< refs below the left child; unset in the leaves of a fast build

  simd::Float8 box() const { return simd::Float8::load(lo.data()); }
};

/// Names a node or a single ref: refs [begin, begin + count), and room for more of them, `capacity` in all,
/// where refs may be doubled. Inner nodes lie in preorder with room for all that the range could need,
/// capacity
/// - 1: so the place of a node depends on the input alone, and threads that build subtrees need not agree on
/// anything.
struct Subtree {
  std::uint32_t node, begin, count, capacity;
};

inline constexpr std::size_t kMaxPrimitives = (std::size_t{1} << 28) - 1;

/// The room for refs in a build of high quality: spatial splits may double one in eight, which keeps all
/// within 64 bytes a triangle.
constexpr std::size_t with_doubles(std::size_t refs) { return refs + refs / 8; }

/// The most primitives of a kind that a leaf holds.
constexpr std::uint32_t leaf_capacity(PrimitiveKind kind) {
  return PrimitiveKinds::kLeafCapacity[number(kind)];
}

struct BinaryBvh {
  HugeVector<BinaryNode> nodes; ///< see Subtree
  HugeVector<BuildRef> refs;    ///< reordered, with gaps where there was room for more
  bool mixed = false;           ///< there are refs of more than one kind
  std::uint32_t count = 0;      ///< refs to begin with
  /// Of inner nodes whose refs may be doubled; empty where none may be.
  struct Room {
    std::uint32_t left_capacity, right_count;
  };
  HugeVector<Room> rooms;

  Subtree root() const { return {0, 0, count, static_cast<std::uint32_t>(refs.size())}; }
  Subtree left(Subtree s) const {
    const std::uint32_t n = nodes[s.node].left_count;
    return {s.node + 1, s.begin, n, s.capacity > s.count ? rooms[s.node].left_capacity : n};
  }
  Subtree right(Subtree s) const {
    const std::uint32_t n = nodes[s.node].left_count;
    if (s.capacity == s.count) return {s.node + n, s.begin + n, s.count - n, s.count - n};
    const Room& room = rooms[s.node];
    return {s.node + room.left_capacity, s.begin + room.left_capacity, room.right_count,
            s.capacity - room.left_capacity};
  }
  BuildBox box(Subtree s) const { return {s.count == 1 ? refs[s.begin].box() : nodes[s.node].box()}; }
  PrimitiveKind kind(Subtree s) const { return refs[s.begin].kind(); }
};

/// Whether count refs at `refs` make up a leaf.
inline bool fits_leaf(const BuildRef* refs, std::uint32_t count, bool mixed) {
  if (count > leaf_capacity(refs->kind())) return false;
  for (std::uint32_t i = 1; mixed && i < count; ++i)
    if (refs[i].tagged_kind != refs->tagged_kind) return false;
  return true;
}

/// bounds are those of all refs, of which there is one at least; their boxes are finite. high builds down to
/// single primitives and plans the wide tree, fast stops at what fits a leaf. Throws Cancelled.
BinaryBvh build_binary_bvh(const AccelInput& input, HugeVector<BuildRef> refs, const RangeBounds& bounds,
                           bool mixed, BuildQuality quality, Progress* progress = nullptr);

} // namespace candela::accel_detail
