#include "accel/binary_bvh.h"

#include "accel/build_stage.h"
#include "accel/collapse_plan.h"
#include "accel/spatial_split.h"
#include "accel/split.h"

#include <algorithm>

namespace candela::accel_detail {

namespace {

using simd::IntVec4;
using simd::Vec4;

/// The refs of a range lie in one of two arrays: `from`, from which a partition moves them to `to`. Out of
/// place it needs no branch that depends on the ref, and half of those would be mispredicted; and ranges in
/// the upper levels are partitioned in parallel.
struct Buffers {
  BuildRef *from, *to;
};

struct Sides {
  RangeBounds left, right;
  std::uint32_t left_count;
  Buffers buffers; ///< of both
  std::uint32_t left_capacity, right_count;
};

class Builder {
public:
  Builder(const AccelInput& input, BinaryBvh& bvh, BuildQuality quality, const BuildStage& stage)
      : cutter_(input), bvh_(bvh), quality_(quality), stage_(stage) {}

  void build(const RangeBounds& bounds) {
    Subtree root = bvh_.root();
    other_.resize(root.capacity);
    root_area_ = bounds.box.half_area();
    pack_cost_ = kPackMemoryCost * bounds.box.half_area() / static_cast<float>(root.count);
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
  // Spatial splits are looked for from so many refs on, of so much of the whole's area: in Sponza all that
  // they bring comes of the upper levels, and looking further down takes three times as long. They are taken
  // where their cost is at most this of the other's; with 0.9 most of the gain is lost.
  static constexpr std::uint32_t kLeastSpatial = 64;
  static constexpr float kLeastSpatialArea = 0.03f;
  static constexpr float kSpatialGain = 0.95f;

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

  static Sides no_sides(const Subtree& s, Buffers buffers) { return {{}, {}, 0, buffers, 0, s.count}; }
  /// The room that is left over goes to both in proportion.
  static void set_left_count(Sides& sides, const Subtree& s, std::uint32_t left, std::uint32_t right) {
    sides.left_count = left;
    sides.right_count = right;
    const std::uint64_t spare = s.capacity - left - right;
    sides.left_capacity = left + static_cast<std::uint32_t>(spare * left / (left + right));
  }

  Sides split_large(const Subtree& s, Buffers buffers, const RangeBounds& bounds, const Binning& binning) {
    Sides sides = no_sides(s, {buffers.to, buffers.from});
    std::vector<Bins> partial(kChunks);
    for_chunks(s, [&](std::uint32_t chunk, std::uint32_t from, std::uint32_t to) {
      binning.fill(buffers.from + from, buffers.from + to, partial[chunk]);
    });
    Bins bins;
    for (const Bins& p : partial) bins.merge(p);
    const Split split = bins.best_split();
    if (split.axis < 0) return sides;
    if (split_space(s, buffers, bounds, bins, split, sides)) return sides;
    const std::uint32_t left_count = bins.count_left(split);
    set_left_count(sides, s, left_count, s.count - left_count);
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
      BuildRef* right = buffers.to + sides.left_capacity + from - lefts_before[chunk];
      partition(binning, split, buffers.from + from, buffers.from + to, left, right, centroids[chunk].first,
                centroids[chunk].second);
    });
    for (const auto& [left, right] : centroids)
      sides.left.centroids.merge(left), sides.right.centroids.merge(right);
    return sides;
  }

  Sides split_bins(const Subtree& s, Buffers buffers, const RangeBounds& bounds, const Binning& binning) {
    Sides sides = no_sides(s, {buffers.to, buffers.from});
    const BuildRef *begin = buffers.from + s.begin, *end = begin + s.count;
    Bins bins;
    binning.fill(begin, end, bins);
    const Split split = bins.best_split();
    if (split.axis < 0) return sides;
    if (split_space(s, buffers, bounds, bins, split, sides)) return sides;
    const std::uint32_t left_count = bins.count_left(split);
    set_left_count(sides, s, left_count, s.count - left_count);
    sides.left.box = bins.box_of(split.axis, 0, split.position);
    sides.right.box = bins.box_of(split.axis, split.position, kBins);
    BuildRef *left = buffers.to + s.begin, *right = left + sides.left_capacity;
    partition(binning, split, begin, end, left, right, sides.left.centroids, sides.right.centroids);
    return sides;
  }

  /// What the split of a list would cost if its sides were cut where they overlap, along the axis where that
  /// changes least: about what a spatial split may gain, to look for one only where that is much.
  static float cost_without_overlap(const Bins& bins, const Split& split, std::uint32_t count) {
    const BuildBox l = bins.box_of(split.axis, 0, split.position),
                   r = bins.box_of(split.axis, split.position, kBins);
    const std::uint32_t n = bins.count_left(split);
    float most = 0; // along the axis that parts them best
    for (int a = 0; a < 3; ++a) {
      // The one that begins first loses what is above the other's begin, and that what is below the first's
      // end.
      const bool ordered = l.lo()[a] <= r.lo()[a];
      const BuildBox &first = ordered ? l : r, &second = ordered ? r : l;
      const float first_size = std::min(first.hi()[a], second.lo()[a]) - first.lo()[a];
      const float second_size =
          second.hi()[a] - std::max(second.lo()[a], std::min(first.hi()[a], second.hi()[a]));
      const float first_area = area_with(first, a, first_size),
                  second_area = area_with(second, a, second_size);
      most = std::max(most, (ordered ? first_area : second_area) * packs_of(n) +
                                (ordered ? second_area : first_area) * packs_of(count - n));
    }
    return most;
  }
  /// Half the area of a box of another size along an axis.
  static float area_with(const BuildBox& box, int axis, float size) {
    simd::Vec4 d = box.hi() - box.lo();
    d[axis] = size;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }

  /// Splits space instead, where that is much better than what `split` of the list would be.
  bool split_space(const Subtree& s, Buffers buffers, const RangeBounds& bounds, const Bins& list,
                   const Split& split, Sides& sides) {
    if (s.capacity == s.count || s.count < kLeastSpatial) return false;
    if (bounds.box.half_area() < kLeastSpatialArea * root_area_) return false;
    if (cost_without_overlap(list, split, s.count) > kSpatialGain * split.cost) return false;
    const BuildRef *begin = buffers.from + s.begin, *end = begin + s.count;
    Split best;
    best.cost = kSpatialGain * split.cost;
    std::uint32_t below = 0, above = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (stage_.cancelled()) return false;
      SpatialBins bins(cutter_, bounds.box, axis);
      if (!bins.usable() || bins.crossings(begin, end) > s.count) continue;
      bins.fill(begin, end);
      const Split here = bins.best_split();
      if (!(here.cost < best.cost)) continue;
      const auto n = static_cast<std::uint32_t>(bins.count_below(here.position));
      const auto m = static_cast<std::uint32_t>(bins.count_above(here.position));
      if (n + m > s.capacity || n >= s.count || m >= s.count) continue;
      best = here, below = n, above = m;
    }
    if (best.axis < 0) return false;
    const auto axis = static_cast<std::size_t>(best.axis);
    const SpatialBins bins(cutter_, bounds.box, axis);
    set_left_count(sides, s, below, above);
    BuildRef *left = buffers.to + s.begin, *right = left + sides.left_capacity;
    BuildRef *const first_left = left, *const first_right = right;
    auto put = [](BuildRef*& out, RangeBounds& into, const BuildRef& ref) {
      *out++ = ref;
      into.grow(ref);
    };
    for (; begin != end; ++begin) {
      if (bins.last_bin(*begin) < best.position) {
        put(left, sides.left, *begin);
      } else if (bins.first_bin(*begin) >= best.position) {
        put(right, sides.right, *begin);
      } else {
        const Parts parts = cutter_.cut(*begin, BuildBox{begin->box()}, axis, bins.plane(best.position));
        if (!is_empty(parts.below)) put(left, sides.left, begin->within(parts.below));
        if (!is_empty(parts.above)) put(right, sides.right, begin->within(parts.above));
      }
    }
    sides.left_count = static_cast<std::uint32_t>(left - first_left);
    sides.right_count = static_cast<std::uint32_t>(right - first_right);
    if (sides.left_count > 0 && sides.right_count > 0) return true;
    sides = no_sides(s, sides.buffers); // the parts that were expected there are empty
    return false;
  }

  /// Takes the bounds of sides that are in place already.
  static Sides sides_in_place(const Subtree& s, Buffers buffers, std::uint32_t left_count) {
    Sides sides{{}, {}, left_count, buffers, left_count, s.count - left_count};
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
        if (as_leaf && split.cost + pack_cost_ >= bounds.box.half_area()) return no_sides(s, buffers);
        return split_few(s, buffers, ranks, split);
      }
      const Binning binning(bounds.centroids);
      if (binning.usable()) {
        Sides sides = s.count >= kParallelRange ? split_large(s, buffers, bounds, binning)
                                                : split_bins(s, buffers, bounds, binning);
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
    const float as_leaf = leaf ? half_area * leaf_cost(first->kind()) + pack_cost_ : kInfinity;
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
    if (s.capacity > s.count) bvh_.rooms[s.node] = {sides.left_capacity, sides.right_count};
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

  Cutter cutter_;
  BinaryBvh& bvh_;
  BuildQuality quality_;
  const BuildStage& stage_;
  HugeVector<BuildRef> other_;
  float pack_cost_ = 0; ///< as an area
  float root_area_ = 0; ///< half of it
};

} // namespace

BinaryBvh build_binary_bvh(const AccelInput& input, HugeVector<BuildRef> refs, const RangeBounds& bounds,
                           bool mixed, BuildQuality quality, Progress* progress) {
  BinaryBvh bvh;
  bvh.count = static_cast<std::uint32_t>(refs.size());
  if (quality == BuildQuality::high && can_cut(input)) {
    refs.resize(with_doubles(refs.size()));
    bvh.rooms.resize(refs.size());
  }
  bvh.nodes.resize(std::max<std::size_t>(refs.size(), 2) - 1);
  bvh.refs = std::move(refs);
  bvh.mixed = mixed;
  Builder(input, bvh, quality, BuildStage(progress, StageWork::binary)).build(bounds);
  return bvh;
}

} // namespace candela::accel_detail
