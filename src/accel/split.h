#pragma once
// Where to split a range of refs: the least surface area heuristic among the borders of bins, or among all
// ways to cut the sequence of centroids where the range is small.

#include "accel/binary_bvh.h"

#include <cmath>

namespace candela::accel_detail {

/// What a side of a split costs to test, over its area: whole packs. Counting these instead of primitives
/// fills leaves better (5.6 triangles each instead of 5.1) and gave 3 % more rays on the large sphere.
/// A lane for each axis. 0 for none, so that a side without any has the cost infinity times 0, NaN, which is
/// never the least.
inline simd::Vec4 packs(simd::IntVec4 counts) {
  return __builtin_convertvector((counts + (kWidth - 1)) >> std::countr_zero(unsigned{kWidth}), simd::Vec4);
}

/// A box for each axis along which to split.
using AxisBoxes = std::array<BuildBox, 3>;

/// Of the boxes of all axes at once.
inline simd::Vec4 half_areas(const AxisBoxes& box) {
  using simd::Vec4;
  Vec4 a = box[0].v.lower() + box[0].v.upper(), b = box[1].v.lower() + box[1].v.upper(),
       c = box[2].v.lower() + box[2].v.upper();
  Vec4 ab_xy = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_z = __builtin_shufflevector(a, b, 2, 6, 2, 6);
  Vec4 x = __builtin_shufflevector(ab_xy, c, 0, 1, 4, 4), y = __builtin_shufflevector(ab_xy, c, 2, 3, 5, 5),
       z = __builtin_shufflevector(ab_z, c, 0, 1, 6, 6);
  return x * (y + z) + y * z;
}

struct Split {
  float cost = kInfinity; ///< area times packs of both sides
  int axis = -1;
  int position = 0; ///< the first bin, or rank, on the right
};

/// The least of what accumulates from both ends over `size` steps along all axes: box(i, axis) and the counts
/// (a lane per axis) at step i.
template <int max_size, class BoxAt, class CountsAt>
inline Split sweep(int size, BoxAt box, CountsAt counts) {
  using simd::IntVec4;
  using simd::Vec4;
  std::array<Vec4, max_size> right_cost;
  AxisBoxes side;
  IntVec4 in_side{};
  for (int i = size - 1; i > 0; --i) {
    for (std::size_t a = 0; a < 3; ++a) side[a].grow(box(i, a));
    in_side += counts(i);
    right_cost[static_cast<std::size_t>(i)] = half_areas(side) * packs(in_side);
  }
  side = {}, in_side = IntVec4{};
  Vec4 best{kInfinity, kInfinity, kInfinity, kInfinity};
  IntVec4 position{};
  for (int i = 1; i < size; ++i) {
    for (std::size_t a = 0; a < 3; ++a) side[a].grow(box(i - 1, a));
    in_side += counts(i - 1);
    Vec4 cost = half_areas(side) * packs(in_side) + right_cost[static_cast<std::size_t>(i)];
    IntVec4 better = cost < best;
    best = simd::min4(cost, best);
    position = (better & i) | (~better & position);
  }
  Split split;
  for (int a = 0; a < 3; ++a)
    if (best[a] < split.cost) split = {best[a], a, position[a]};
  return split;
}

/// With 32: no more rays per second. With 8 for fewer than 32 refs: as fast, and packs less full.
inline constexpr int kBins = 16;

struct Bins {
  std::array<std::array<simd::Float8, 3>, kBins> box;
  std::array<std::array<std::int32_t, 4>, kBins> count; ///< a lane per axis

  Bins() {
    const simd::Float8 none = BuildBox{}.v;
    for (std::size_t i = 0; i < kBins; ++i) box[i] = {none, none, none}, count[i] = {};
  }
  void merge(const Bins& b) {
    for (std::size_t i = 0; i < kBins; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box[i][axis] = min(b.box[i][axis], box[i][axis]);
        count[i][axis] += b.count[i][axis];
      }
  }
  Split best_split() const {
    return sweep<kBins>(
        kBins, [this](int i, std::size_t axis) { return box[static_cast<std::size_t>(i)][axis]; },
        [this](int i) {
          const auto& c = count[static_cast<std::size_t>(i)];
          return simd::IntVec4{c[0], c[1], c[2], 0};
        });
  }
  std::uint32_t count_left(const Split& split) const {
    std::int32_t sum = 0;
    for (int i = 0; i < split.position; ++i)
      sum += count[static_cast<std::size_t>(i)][static_cast<std::size_t>(split.axis)];
    return static_cast<std::uint32_t>(sum);
  }
  BuildBox box_of(int axis, int from, int to) const {
    BuildBox result;
    for (int i = from; i < to; ++i)
      result.grow(box[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)]);
    return result;
  }
};

/// Maps centroids to bins.
struct Binning {
  alignas(16) std::array<float, 4> origin, scale;

  explicit Binning(const CentroidBounds& centroids) {
    simd::Vec4 extent = centroids.hi - centroids.lo;
    for (int a = 0; a < 4; ++a) {
      auto i = static_cast<std::size_t>(a);
      float s = a < 3 && extent[a] > 0 ? 0.9999f * kBins / extent[a] : 0.0f;
      origin[i] = a < 3 ? centroids.lo[a] : 0;
      scale[i] = std::isfinite(s) ? s : 0.0f; // denormal extents: treat as coincident
    }
  }
  bool usable() const { return scale[0] > 0 || scale[1] > 0 || scale[2] > 0; }

  /// Of all axes; in range, for the product lies in [0, 0.9999 kBins].
  void fill(const BuildRef* from, const BuildRef* to, Bins& result) const {
    const simd::Vec4 o{origin[0], origin[1], origin[2], 0}, s{scale[0], scale[1], scale[2], 0};
    for (; from != to; ++from) {
      simd::Float8 box = from->box();
      simd::IntVec4 bin = __builtin_convertvector((twice_centroid(box) - o) * s, simd::IntVec4);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto b = static_cast<std::size_t>(bin[static_cast<int>(axis)]);
        result.box[b][axis] = min(box, result.box[b][axis]);
        ++result.count[b][axis];
      }
    }
  }
  /// Of one ref along one axis: the same arithmetic, so the same bin.
  int bin(const BuildRef& ref, std::size_t axis) const {
    return static_cast<int>(((ref.lo[axis] - ref.negated_hi[axis]) - origin[axis]) * scale[axis]);
  }
};

/// Up to this many refs the cut is looked for among all places rather than among bins: as fast, for there are
/// no bins to clear, and exact.
inline constexpr std::uint32_t kSweepRange = 16;

/// The order of the centroids of few refs along each axis.
class Ranks {
public:
  Ranks(const BuildRef* refs, std::uint32_t count) : refs_(refs), count_(count) {
    std::array<simd::Vec4, kSweepRange> c;
    std::array<simd::IntVec4, kSweepRange> rank;
    for (std::uint32_t i = 0; i < count; ++i) c[i] = twice_centroid(refs[i].box()), rank[i] = simd::IntVec4{};
    for (std::uint32_t i = 1; i < count; ++i)
      for (std::uint32_t j = 0; j < i; ++j) {
        // A mask is -1 where it holds: the one that is not before the other moves up.
        simd::IntVec4 before = c[i] < c[j];
        rank[j] -= before;
        rank[i] += before + 1;
      }
    for (std::uint32_t i = 0; i < count; ++i)
      for (int a = 0; a < 3; ++a)
        order_[static_cast<std::size_t>(a)][static_cast<std::size_t>(rank[i][a])] =
            static_cast<std::uint8_t>(i);
  }
  Split best_split() const {
    return sweep<static_cast<int>(kSweepRange)>(
        static_cast<int>(count_),
        [this](int i, std::size_t axis) { return at(static_cast<int>(axis), i).box(); },
        [](int) {
          return simd::IntVec4{1, 1, 1, 1};
        });
  }
  const BuildRef& at(int axis, int rank) const {
    return refs_[order_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(rank)]];
  }

private:
  const BuildRef* refs_;
  std::uint32_t count_;
  std::array<std::array<std::uint8_t, kSweepRange>, 3> order_;
};

} // namespace candela::accel_detail
