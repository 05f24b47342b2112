#include "accel/binary_bvh.h"

#include "accel/build_stage.h"
#include "accel/collapse_plan.h"
#include "accel/split.h"

#include <algorithm>

namespace candela::accel_detail {

namespace {

using simd::IntVec4;
using simd::Vec4;

/// The refs of a range lie in one of two arrays: `from`, whence a partition brings them to `to`. Out of place
/// it needs no branch that depends on the ref, and half of those would be mispredicted; and ranges in the
/// upper levels are partitioned in parallel.
struct Buffers {
  BuildRef *from, *to;
};

struct Sides {
  RangeBounds left, right;
  std::uint32_t left_count;
  Buffers buffers; ///< of both
};

class Builder {
public:
  Builder(BinaryBvh& bvh, BuildQuality quality, const BuildStage& stage)
      : bvh_(bvh), quality_(quality), stage_(stage) {}

  void build(const RangeBounds& bounds) {
    Subtree root = bvh_.root();
    other_.resize(root.count);
    pack_price_ = kPackPrice * bounds.box.half_area() / static_cast<float>(root.count);
    ForestCosts cost;
    build_subtree(root, {bvh_.refs.data(), other_.data()}, bounds, 1, cost);
    stage_.check();
  }

private:
  // Below: one task does it all. Above kParallelRange the passes over the range are parallel too. The chunks
  // do not depend on the number of threads, and neither minima, maxima nor counts depend on the order of
  // merging.
  static constexpr std::uint32_t kTaskRange = 2048;
  static constexpr std::uint32_t kParallelRange = 1u << 16;
  static constexpr std::uint32_t kChunks = 32;

  /// Calls visit(chunk, from, to) for all chunks of a large range.
  template <class Visit>
  void for_chunks(const Subtree& s, Visit visit) {
    auto at = [&](std::uint32_t chunk) {
      return s.begin + static_cast<std::uint32_t>(std::uint64_t{s.count} * chunk / kChunks);
    };
#pragma omp taskloop default(shared) grainsize(1)
    for (std::uint32_t chunk = 0; chunk < kChunks; ++chunk)
      if (!stage_.cancelled()) visit(chunk, at(chunk), at(chunk + 1));
  }

  /// Brings the refs [from, to) to where the sides of the split begin and takes the bounds of their centroids
  /// on the way.
  static void partition(const Binning& binning, const Split& split, const BuildRef* from, const BuildRef* to,
                        BuildRef* left, BuildRef* right, CentroidBounds& left_bounds,
                        CentroidBounds& right_bounds) {
    const auto axis = static_cast<std::size_t>(split.axis);
    CentroidBounds in_left = left_bounds, in_right = right_bounds;
    for (; from != to; ++from) {
      const BuildRef ref = *from;
      const bool is_left = binning.bin(ref, axis) < split.position;
      // All bits set are a NaN, which grows nothing.
      const std::int32_t bits = -static_cast<std::int32_t>(is_left);
      const IntVec4 mask{bits, bits, bits, bits}, c = reinterpret_cast<IntVec4>(twice_centroid(ref.box()));
      in_left.grow(reinterpret_cast<Vec4>(c | ~mask));
      in_right.grow(reinterpret_cast<Vec4>(c | mask));
      *(is_left ? left : right) = ref;
      left += is_left, right += !is_left;
    }
    left_bounds = in_left, right_bounds = in_right;
  }

  Sides split_large(const Subtree& s, Buffers buffers, const Binning& binning) {
    Sides sides{{}, {}, 0, {buffers.to, buffers.from}};
    std::vector<Bins> partial(kChunks);
    for_chunks(s, [&](std::uint32_t chunk, std::uint32_t from, std::uint32_t to) {
      binning.fill(buffers.from + from, buffers.from + to, partial[chunk]);
    });
    Bins bins;
    for (const Bins& p : partial) bins.merge(p);
    const Split split = bins.best_split();
    if (split.axis < 0) return sides;
    sides.left_count = bins.count_left(split);
    sides.left.box = bins.box_of(split.axis, 0, split.position);
    sides.right.box = bins.box_of(split.axis, split.position, kBins);
    // The bins of the chunks tell where in either side each of them begins.
    std::array<std::uint32_t, kChunks> lefts_before;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < kChunks; ++i) {
      lefts_before[i] = sum;
      sum += partial[i].count_left(split);
    }
    std::array<std::pair<CentroidBounds, CentroidBounds>, kChunks> centroids;
    for_chunks(s, [&](std::uint32_t chunk, std::uint32_t from, std::uint32_t to) {
      BuildRef* left = buffers.to + s.begin + lefts_before[chunk];
      BuildRef* right = buffers.to + sides.left_count + from - lefts_before[chunk];
      partition(binning, split, buffers.from + from, buffers.from + to, left, right, centroids[chunk].first,
                centroids[chunk].second);
    });
    for (const auto& [left, right] : centroids)
      sides.left.centroids.merge(left), sides.right.centroids.merge(right);
    return sides;
  }

  Sides split_bins(const Subtree& s, Buffers buffers, const Binning& binning) {
    Sides sides{{}, {}, 0, {buffers.to, buffers.from}};
    const BuildRef *begin = buffers.from + s.begin, *end = begin + s.count;
    Bins bins;
    binning.fill(begin, end, bins);
    const Split split = bins.best_split();
    if (split.axis < 0) return sides;
    sides.left_count = bins.count_left(split);
    sides.left.box = bins.box_of(split.axis, 0, split.position);
    sides.right.box = bins.box_of(split.axis, split.position, kBins);
    BuildRef *left = buffers.to + s.begin, *right = left + sides.left_count;
    partition(binning, split, begin, end, left, right, sides.left.centroids, sides.right.centroids);
    return sides;
  }

  /// Takes the bounds of sides that are in place already.
  static Sides sides_in_place(const Subtree& s, Buffers buffers, std::uint32_t left_count) {
    Sides sides{{}, {}, left_count, buffers};
    const BuildRef* ref = buffers.from + s.begin;
    for (std::uint32_t i = 0; i < left_count; ++i) sides.left.grow(*ref++);
    for (std::uint32_t i = left_count; i < s.count; ++i) sides.right.grow(*ref++);
    return sides;
  }

  static Sides split_few(const Subtree& s, Buffers buffers, const Ranks& ranks, const Split& split) {
    BuildRef* to = buffers.to + s.begin;
    for (std::uint32_t i = 0; i < s.count; ++i) to[i] = ranks.at(split.axis, static_cast<int>(i));
    return sides_in_place(s, {buffers.to, buffers.from}, static_cast<std::uint32_t>(split.position));
  }

  /// Halves along the longest axis of the centroids.
  static Sides halve(const Subtree& s, Buffers buffers, const RangeBounds& bounds) {
    Vec4 extent = bounds.centroids.hi - bounds.centroids.lo;
    int axis = extent[0] >= extent[1] ? (extent[0] >= extent[2] ? 0 : 2) : (extent[1] >= extent[2] ? 1 : 2);
    BuildRef* begin = buffers.from + s.begin;
    std::nth_element(begin, begin + s.count / 2, begin + s.count,
                     [axis](const BuildRef& a, const BuildRef& b) {
                       return twice_centroid(a.box())[axis] < twice_centroid(b.box())[axis];
                     });
    return sides_in_place(s, buffers, s.count / 2);
  }

  /// as_leaf: it may stay one, then there is no split where two packs would cost no less than one.
  Sides split(const Subtree& s, Buffers buffers, const RangeBounds& bounds, int depth, bool as_leaf) {
    // From here on halving is the only way to stay within the depth: 2^(levels left) primitives.
    int levels_left = kMaxDepth - depth - 1;
    if (static_cast<int>(std::bit_width(s.count - 1)) < levels_left) {
      if (s.count <= kSweepRange) {
        const Ranks ranks(buffers.from + s.begin, s.count);
        const Split split = ranks.best_split();
        if (as_leaf && split.cost + pack_price_ >= bounds.box.half_area()) return {{}, {}, 0, buffers};
        return split_few(s, buffers, ranks, split);
      }
      const Binning binning(bounds.centroids);
      if (binning.usable()) {
        Sides sides =
            s.count >= kParallelRange ? split_large(s, buffers, binning) : split_bins(s, buffers, binning);
        if (sides.left_count) return sides;
      }
    }
    return halve(s, buffers, bounds);
  }

  /// Brings the refs of a leaf to where they stay.
  void settle(const Subtree& s, Buffers buffers) {
    if (buffers.from == bvh_.refs.data()) return;
    std::copy_n(buffers.from + s.begin, s.count, buffers.to + s.begin);
  }

  /// One that may be a task of its own. Cancelled, it leaves its nodes as they are.
  void build_subtree(const Subtree& s, Buffers buffers, const RangeBounds& bounds, int depth,
                     ForestCosts& cost) {
    if (stage_.cancelled()) return;
    build_range(s, buffers, bounds, depth, cost);
    if (s.count < kTaskRange) stage_.done(s.count);
  }

  void build_range(const Subtree& s, Buffers buffers, const RangeBounds& bounds, int depth,
                   ForestCosts& cost) {
    const BuildRef* first = buffers.from + s.begin;
    const float half_area = bounds.box.half_area();
    const bool leaf = fits_leaf(first, s.count, bvh_.mixed);
    const float as_leaf = leaf ? half_area * leaf_cost(first->kind()) + pack_price_ : kInfinity;
    if (s.count == 1) {
      settle(s, buffers);
      cost.fill(as_leaf);
      return;
    }
    BinaryNode& node = bvh_.nodes[s.node];
    bounds.box.v.store(node.lo.data()); // the lanes to spare follow
    if (leaf && quality_ == BuildQuality::fast) {
      settle(s, buffers);
      return;
    }
    const Sides sides = split(s, buffers, bounds, depth, leaf);
    if (sides.left_count == 0) {
      settle(s, buffers);
      cost.fill(as_leaf);
      node.plan = CollapsePlan::leaf().bits;
      return;
    }
    node.left_count = sides.left_count;
    Subtree left = bvh_.left(s), right = bvh_.right(s);
    ForestCosts left_cost, right_cost;
    if (s.count >= kTaskRange) {
#pragma omp task default(shared)
      build_subtree(left, sides.buffers, sides.left, depth + 1, left_cost);
      build_subtree(right, sides.buffers, sides.right, depth + 1, right_cost);
#pragma omp taskwait
    } else {
      build_range(left, sides.buffers, sides.left, depth + 1, left_cost);
      build_range(right, sides.buffers, sides.right, depth + 1, right_cost);
    }
    if (quality_ == BuildQuality::high)
      node.plan = plan_node(half_area, as_leaf, left_cost, right_cost, cost).bits;
  }

  BinaryBvh& bvh_;
  BuildQuality quality_;
  const BuildStage& stage_;
  HugeVector<BuildRef> other_;
  float pack_price_ = 0; ///< as an area
};

} // namespace

BinaryBvh build_binary_bvh(HugeVector<BuildRef> refs, const RangeBounds& bounds, bool mixed,
                           BuildQuality quality, Progress* progress) {
  BinaryBvh bvh;
  bvh.nodes.resize(std::max<std::size_t>(refs.size(), 2) - 1);
  bvh.refs = std::move(refs);
  bvh.mixed = mixed;
  Builder(bvh, quality, BuildStage(progress, StageWork::binary)).build(bounds);
  return bvh;
}

} // namespace candela::accel_detail
