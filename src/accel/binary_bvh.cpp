#include "accel/binary_bvh.h"

#include "accel/build_stage.h"

#include <algorithm>
#include <bit>

namespace candela::accel_detail {

namespace {

using simd::IntVec4;
using simd::max4;
using simd::min4;
using simd::Vec4;

struct Box4 {
  Vec4 lo{kInfinity, kInfinity, kInfinity, kInfinity};
  Vec4 hi{-kInfinity, -kInfinity, -kInfinity, -kInfinity};

  void grow(Vec4 low, Vec4 high) { lo = min4(lo, low), hi = max4(hi, high); }
  void grow(const Box4& b) { grow(b.lo, b.hi); }
  float half_area() const {
    Vec4 d = hi - lo, turned = __builtin_shufflevector(d, d, 1, 2, 0, 3), product = d * turned;
    return product[0] + product[1] + product[2];
  }
};

/// The fourth lane is 0: index and kind, which lie there, look like denormal numbers, and those are slow.
inline Vec4 xyz(const std::array<float, 3>& p) {
  return reinterpret_cast<Vec4>(*reinterpret_cast<const IntVec4*>(p.data()) & IntVec4{-1, -1, -1, 0});
}
inline Vec4 low(const BuildRef& ref) { return xyz(ref.lo); }
inline Vec4 high(const BuildRef& ref) { return xyz(ref.hi); }
inline Vec4 centroid(const BuildRef& ref) { return (low(ref) + high(ref)) * 0.5f; }

constexpr int kMaxBins = 16;

/// Only the first `size` of each axis are in use and set: most ranges are small, and clearing bins is a good
/// part of their time.
struct Bins {
  std::array<std::array<Box4, kMaxBins>, 3> box;
  std::array<std::array<std::uint32_t, kMaxBins>, 3> count;
  std::size_t size;

  explicit Bins(int bins) : size(static_cast<std::size_t>(bins)) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < size; ++i) box[axis][i] = Box4{}, count[axis][i] = 0;
  }
  void merge(const Bins& b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < size; ++i) {
        box[axis][i].grow(b.box[axis][i]);
        count[axis][i] += b.count[axis][i];
      }
  }
};

/// The boxes of a range: of the primitives and of their centroids.
struct RangeBounds {
  Box4 box, centroids;
  std::uint32_t kinds = 0; ///< a bit each

  void grow(const BuildRef& ref) {
    box.grow(low(ref), high(ref));
    Vec4 c = centroid(ref);
    centroids.grow(c, c);
    kinds |= 1u << static_cast<std::uint32_t>(ref.kind);
  }
  void merge(const RangeBounds& b) { box.grow(b.box), centroids.grow(b.centroids), kinds |= b.kinds; }
};

/// Maps centroids to bins.
struct Binning {
  Vec4 origin, scale;
  int bins;

  Binning(const Box4& centroids, int bin_count) : origin(centroids.lo), bins(bin_count) {
    Vec4 extent = centroids.hi - centroids.lo;
    scale = Vec4{0, 0, 0, 0};
    for (int a = 0; a < 3; ++a)
      if (extent[a] > 0) {
        float s = 0.9999f * static_cast<float>(bins) / extent[a];
        scale[a] = std::isfinite(s) ? s : 0.0f; // denormal extents: treat as coincident
      }
  }
  bool usable(int a) const { return scale[a] > 0; }
  /// Of all axes; in range, for the product lies in [0, 0.9999 bins].
  IntVec4 bin(Vec4 c) const { return __builtin_convertvector((c - origin) * scale, IntVec4); }
};

struct Split {
  float cost = kInfinity; ///< area times packs of both sides
  int axis = -1;
  int first_right_bin = 0;
};

/// What a side of a split costs to test, over its area: whole packs. Counting these instead of primitives
/// fills leaves better (5.6 triangles each instead of 5.1) and gave 3 % more rays on the large sphere.
float packs(std::uint32_t count) { return static_cast<float>((count + kWidth - 1) / kWidth); }

class Builder {
public:
  Builder(BinaryBvh& bvh, BuildQuality quality, const BuildStage& stage)
      : bvh_(bvh), quality_(quality), stage_(stage) {}

  void build() {
    auto count = static_cast<std::uint32_t>(bvh_.refs.size());
#pragma omp parallel if (count >= kTaskRange)
#pragma omp single
    build_subtree(0, 0, count, range_bounds(0, count), 1);
    stage_.check();
  }

private:
  // Below: one task does it all. Above kParallelRange the passes over the range are parallel too. The chunks
  // do not depend on the number of threads, and neither minima, maxima nor counts depend on the order of
  // merging.
  static constexpr std::uint32_t kTaskRange = 2048;
  static constexpr std::uint32_t kParallelRange = 1u << 17;
  static constexpr std::uint32_t kChunks = 16;

  BuildRef* refs() { return bvh_.refs.data(); }

  /// Runs visit(from, to, result) over the range, in parallel chunks with a result each if it is large.
  template <class Result, class Visit>
  void reduce(std::uint32_t begin, std::uint32_t end, Result& result, Visit visit) {
    if (end - begin < kParallelRange) {
      visit(begin, end, result);
      return;
    }
    std::vector<Result> partial(kChunks, result);
    auto at = [=](std::uint32_t chunk) {
      return begin + static_cast<std::uint32_t>(std::uint64_t{end - begin} * chunk / kChunks);
    };
#pragma omp taskloop default(shared) grainsize(1)
    for (std::uint32_t chunk = 0; chunk < kChunks; ++chunk) visit(at(chunk), at(chunk + 1), partial[chunk]);
    for (const Result& p : partial) result.merge(p);
  }

  RangeBounds range_bounds(std::uint32_t begin, std::uint32_t end) {
    RangeBounds bounds;
    reduce(begin, end, bounds, [this](std::uint32_t from, std::uint32_t to, RangeBounds& result) {
      for (std::uint32_t i = from; i < to; ++i) result.grow(refs()[i]);
    });
    return bounds;
  }

  Split best_split(const Bins& bins, const Binning& binning) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!binning.usable(axis)) continue;
      const auto& box = bins.box[static_cast<std::size_t>(axis)];
      const auto& count = bins.count[static_cast<std::size_t>(axis)];
      std::array<float, kMaxBins> right_cost;
      Box4 side;
      std::uint32_t in_side = 0;
      for (std::size_t i = bins.size - 1; i > 0; --i) {
        side.grow(box[i]);
        in_side += count[i];
        right_cost[i] = in_side ? side.half_area() * packs(in_side) : kInfinity;
      }
      side = Box4{}, in_side = 0;
      for (std::size_t i = 1; i < bins.size; ++i) {
        side.grow(box[i - 1]);
        in_side += count[i - 1];
        if (!in_side) continue;
        float cost = side.half_area() * packs(in_side) + right_cost[i];
        if (cost < best.cost) best = {cost, axis, static_cast<int>(i)};
      }
    }
    return best;
  }

  /// More would be more work in the many small ranges, and gain nothing (32: no more rays per second).
  static int bin_count(std::uint32_t count) { return count <= 4 ? 4 : count <= 32 ? 8 : kMaxBins; }

  void fill(const Binning& binning, std::uint32_t begin, std::uint32_t end, Bins& bins) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const BuildRef& ref = refs()[i];
      Vec4 lo = low(ref), hi = high(ref);
      IntVec4 bin = binning.bin(centroid(ref));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto b = static_cast<std::size_t>(bin[static_cast<int>(axis)]);
        bins.box[axis][b].grow(lo, hi);
        ++bins.count[axis][b];
      }
    }
  }

  /// Partitions the range and takes the bounds of both sides on the way; gives the first index of the right
  /// one.
  template <class IsLeft>
  std::uint32_t partition(std::uint32_t begin, std::uint32_t end, IsLeft is_left, RangeBounds& left,
                          RangeBounds& right) {
    if (end - begin >= kParallelRange) {
      BuildRef* mid = std::partition(refs() + begin, refs() + end, is_left);
      auto middle = static_cast<std::uint32_t>(mid - refs());
      left = range_bounds(begin, middle), right = range_bounds(middle, end);
      return middle;
    }
    for (;;) {
      for (; begin < end && is_left(refs()[begin]); ++begin) left.grow(refs()[begin]);
      for (; begin < end && !is_left(refs()[end - 1]); --end) right.grow(refs()[end - 1]);
      if (begin == end) return begin;
      std::swap(refs()[begin], refs()[end - 1]);
      left.grow(refs()[begin++]);
      right.grow(refs()[--end]);
    }
  }

  /// Partitions the range; gives the first index of the right part and the bounds of both.
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, const RangeBounds& bounds, int depth,
                      RangeBounds& left, RangeBounds& right) {
    // From here on halving is the only way to stay within the depth: 2^(levels left) primitives.
    int levels_left = kMaxDepth - depth - 1;
    bool must_halve = static_cast<int>(std::bit_width(end - begin - 1)) >= levels_left;
    Binning binning(bounds.centroids, bin_count(end - begin));
    if (end - begin > 2 && !must_halve && (binning.usable(0) || binning.usable(1) || binning.usable(2))) {
      Bins bins(binning.bins);
      reduce(begin, end, bins, [this, &binning](std::uint32_t from, std::uint32_t to, Bins& result) {
        fill(binning, from, to, result);
      });
      if (Split best = best_split(bins, binning); best.axis >= 0) {
        auto is_left = [&](const BuildRef& ref) {
          return binning.bin(centroid(ref))[best.axis] < best.first_right_bin;
        };
        return partition(begin, end, is_left, left, right);
      }
    }
    // Two, coincident centroids or no depth left: halves along the longest axis of the centroids.
    Vec4 extent = bounds.centroids.hi - bounds.centroids.lo;
    int axis = extent[0] >= extent[1] ? (extent[0] >= extent[2] ? 0 : 2) : (extent[1] >= extent[2] ? 1 : 2);
    std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        refs() + begin, refs() + middle, refs() + end,
        [axis](const BuildRef& a, const BuildRef& b) { return centroid(a)[axis] < centroid(b)[axis]; });
    left = range_bounds(begin, middle), right = range_bounds(middle, end);
    return middle;
  }

  /// One that may be a task of its own. Cancelled, it leaves its nodes as they are.
  void build_subtree(std::uint32_t node, std::uint32_t begin, std::uint32_t end, const RangeBounds& bounds,
                     int depth) {
    if (stage_.cancelled()) return;
    build_range(node, begin, end, bounds, depth);
    if (end - begin < kTaskRange) stage_.done(end - begin);
  }

  void build_range(std::uint32_t node_index, std::uint32_t begin, std::uint32_t end,
                   const RangeBounds& bounds, int depth) {
    BinaryNode& node = bvh_.nodes[node_index];
    for (std::size_t a = 0; a < 3; ++a) node.lo[a] = bounds.box.lo[a], node.hi[a] = bounds.box.hi[a];
    std::uint32_t count = end - begin;
    node.begin = begin, node.count = count & kMaxPrimitives;
    node.mixed = !std::has_single_bit(bounds.kinds);
    std::uint32_t stop = quality_ == BuildQuality::high ? 1 : leaf_capacity(refs()[begin].kind);
    node.leaf = !node.mixed && count <= stop;
    if (node.leaf) return;
    RangeBounds left, right;
    std::uint32_t middle = split(begin, end, bounds, depth, left, right);
    std::uint32_t left_node = node_index + 1, right_node = node_index + 2 * (middle - begin);
    if (count >= kTaskRange) {
#pragma omp task default(shared) firstprivate(left_node, begin, middle, depth)
      build_subtree(left_node, begin, middle, left, depth + 1);
      build_subtree(right_node, middle, end, right, depth + 1);
#pragma omp taskwait
    } else {
      build_range(left_node, begin, middle, left, depth + 1);
      build_range(right_node, middle, end, right, depth + 1);
    }
  }

  BinaryBvh& bvh_;
  BuildQuality quality_;
  const BuildStage& stage_;
};

} // namespace

BinaryBvh build_binary_bvh(std::vector<BuildRef> refs, BuildQuality quality, Progress* progress) {
  BinaryBvh bvh;
  bvh.nodes = std::make_unique_for_overwrite<BinaryNode[]>(2 * refs.size() - 1);
  bvh.refs = std::move(refs);
  Builder(bvh, quality, BuildStage(progress, StageWork::binary)).build();
  return bvh;
}

} // namespace candela::accel_detail
