#pragma once
// Neighbouring rays, as a camera sends them or as surfaces that it sees send them to a light.
//
// They share the upper part of their way through the tree, which is found once for all of them, with a
// frustum around them (the entry point search of Reshetov, Soupikov and Hurley 2005, "Multi-Level Ray Tracing
// Algorithm", ACM TOG 24(3); here with up to kMaxEntryPoints of them). Where that ends at leaves and the
// frustum meets but few of their triangles, eight rays at a time are tested with each. Else every ray goes on
// alone from the entry points, so that rays that part company lose nothing. What a ray meets is the same in
// either way.
//
// Nanoseconds of a ray alone and in a packet, 512 x 512 pixels, at 1 and at 16 samples a pixel:
//
//                               camera rays             their shadow rays
//   Cornell box                 34   8    36   9        29  16     31  18
//   bunny, 69,000 triangles     79  57    60  20        97  94     82  58
//   Sponza, 66,000             122  68   115  33        84  86     74  48
//   sphere, 1.3 million        151 137    69  40       201 213    144 108
//
// The whole render of the Cornell box is 1.10 times as fast where paths do not split, 1.03 times where they
// split in two.

#include "accel/packet_frustum.h"
#include "accel/traversal.h"

namespace candela::accel_detail {

/// At 8, rays in Sponza take 1.2 to 1.6 times as long; at 24, what is 5 % faster in Sponza is 5 % slower on
/// the sphere.
inline constexpr std::size_t kMaxEntryPoints = 16;
/// From 12 to 48, no ray takes 10 % more or less time.
inline constexpr std::size_t kMaxTriangles = 24;

/// Subtrees and leaves that hold all that the rays of a packet can meet, the one to enter first last.
struct EntryPoints {
  std::array<Waiting, kMaxEntryPoints> at;
  std::size_t count = 0;
  bool only_leaves = true;

  std::span<const Waiting> span() const { return {at.data(), count}; }
};

template <class F>
EntryPoints find_entry_points(const AccelTree& tree, const std::optional<PacketFrustum<F>>& frustum) {
  EntryPoints points;
  points.at[points.count++] = {tree.root, 0};
  if (!frustum) {
    points.only_leaves = tree.root.is_leaf();
    return points;
  }
  for (std::size_t i = 0; i < points.count;) {
    const ChildRef ref = points.at[i].value;
    if (ref.is_leaf()) {
      ++i;
      continue;
    }
    const WideNode& node = tree.nodes[ref.index()];
    F t_enter;
    const simd::LaneMask met = frustum->intersect(node, t_enter);
    if (points.count - 1 + static_cast<std::size_t>(std::popcount(met)) > kMaxEntryPoints) {
      points.only_leaves = false;
      ++i;
      continue;
    }
    points.at[i] = points.at[--points.count]; // its children instead
    alignas(32) std::array<float, kWidth> key;
    t_enter.store(key.data());
    simd::for_each_lane(met, [&](int lane) {
      const auto k = static_cast<std::size_t>(lane);
      points.at[points.count++] = {node.child[k], key[k]};
    });
  }
  std::sort(points.at.begin(), points.at.begin() + static_cast<std::ptrdiff_t>(points.count),
            [](const Waiting& a, const Waiting& b) { return a.key > b.key; });
  return points;
}

/// The triangles that a packet can meet.
class FewTriangles {
public:
  /// False where they are many, or where the packet can meet something else.
  template <class F>
  bool find(const AccelTree& tree, const EntryPoints& points, const PacketFrustum<F>& frustum) {
    count_ = 0;
    for (const Waiting& leaf : points.span()) {
      if (leaf.value.kind() != LeafKind::triangles) return false;
      const TrianglePack& pack = tree.triangles[leaf.value.index()];
      const simd::LaneMask met = frustum.intersect(pack);
      if (count_ + static_cast<std::size_t>(std::popcount(met)) > kMaxTriangles) return false;
      simd::for_each_lane(met, [&](int lane) {
        const auto k = static_cast<std::size_t>(lane);
        insert({&pack, k, pack.primitive[k]});
      });
    }
    return true;
  }
  std::span<const PackedTriangle> span() const { return {triangles_.data(), count_}; }

private:
  /// By primitive, so that the first of those at the same t is the one that precedes; once, if it is in two
  /// leaves.
  void insert(const PackedTriangle& triangle) {
    const auto end = triangles_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto at = std::lower_bound(
        triangles_.begin(), end, triangle.primitive,
        [](const PackedTriangle& t, std::uint32_t primitive) { return t.primitive < primitive; });
    if (at != end && at->primitive == triangle.primitive) return;
    std::copy_backward(at, end, end + 1);
    *at = triangle;
    ++count_;
  }

  std::array<PackedTriangle, kMaxTriangles> triangles_;
  std::size_t count_ = 0;
};

/// Neighbouring rays, of which there is one at least.
template <class F>
class Packet {
public:
  Packet(const AccelTree& tree, std::span<const Ray* const> rays) : tree_(tree), rays_(rays) {
    const bool alike = lanes_.load(rays);
    const auto frustum = PacketFrustum<F>::around(lanes_, tree);
    points_ = find_entry_points(tree, frustum);
    few_ = frustum && alike && points_.only_leaves && triangles_.find(tree, points_, *frustum);
  }

  /// As trace, for all; the t of rays that meet nothing becomes infinite.
  void intersect(std::span<Hit> hits) const {
    if (few_) {
      for (std::size_t group = 0; group < lanes_.groups; ++group) meet_few(group, hits);
      return;
    }
    for (std::size_t i = 0; i < rays_.size(); ++i)
      if (!trace_alone<false>(i, hits[i])) hits[i].t = kInfinity;
  }
  void occluded(std::span<bool> result) const {
    if (few_) {
      for (std::size_t group = 0; group < lanes_.groups; ++group) {
        const simd::LaneMask met = meet_any(group);
        for (std::size_t i = group * kWidth; i < std::min((group + 1) * kWidth, rays_.size()); ++i)
          result[i] = met >> (i - group * kWidth) & 1;
      }
      return;
    }
    Hit unused;
    for (std::size_t i = 0; i < rays_.size(); ++i) result[i] = trace_alone<true>(i, unused);
  }

  /// How the rays are traced.
  struct Ways {
    bool few_triangles;       ///< all rays with each of
    std::size_t triangles;    ///< so many
    std::size_t entry_points; ///< or each ray from there
  };
  Ways ways() const { return {few_, triangles_.span().size(), points_.count}; }

private:
  template <bool any_hit>
  bool trace_alone(std::size_t i, Hit& hit) const {
    NoCost free_of_charge;
    if (points_.only_leaves)
      return trace_subtrees<F, any_hit, true>(tree_, points_.span(), *rays_[i], hit, free_of_charge);
    return trace_subtrees<F, any_hit, false>(tree_, points_.span(), *rays_[i], hit, free_of_charge);
  }

  void meet_few(std::size_t group, std::span<Hit> hits) const {
    const std::size_t first = group * kWidth;
    const ShearedRay<F> ray = lanes_.group(group);
    const F t_min = F::load(&lanes_.t_min[first]);
    F t_max = F::load(&lanes_.t_max[first]), u(0.0f), v(0.0f), primitive(0.0f);
    simd::LaneMask met = 0;
    for (const PackedTriangle& triangle : triangles_.span()) {
      const TriangleHits<F> found(triangle, ray);
      if (!found.lanes) continue;
      const simd::LaneMask closer = found.lanes & less(t_min, found.t) & less(found.t, t_max);
      if (!closer) continue;
      met |= closer;
      const F inverse = F(1.0f) / found.determinant;
      t_max = select_lanes(closer, found.t, t_max);
      u = select_lanes(closer, found.edge.v * inverse, u);
      v = select_lanes(closer, found.edge.w * inverse, v);
      primitive = select_lanes(closer, F(std::bit_cast<float>(triangle.primitive)), primitive);
    }
    alignas(32) std::array<float, kWidth> ts, us, vs, primitives;
    select_lanes(met, t_max, F(kInfinity)).store(ts.data());
    u.store(us.data()), v.store(vs.data()), primitive.store(primitives.data());
    for (std::size_t k = 0; k < std::min<std::size_t>(kWidth, rays_.size() - first); ++k)
      hits[first + k] = {ts[k],       us[k],
                         vs[k],       std::bit_cast<std::uint32_t>(primitives[k]),
                         kNoInstance, PrimitiveKind::triangle};
  }

  simd::LaneMask meet_any(std::size_t group) const {
    const ShearedRay<F> ray = lanes_.group(group);
    const F t_min = F::load(&lanes_.t_min[group * kWidth]), t_max = F::load(&lanes_.t_max[group * kWidth]);
    simd::LaneMask met = 0;
    for (const PackedTriangle& triangle : triangles_.span()) {
      const TriangleHits<F> found(triangle, ray);
      if (!found.lanes) continue;
      met |= found.lanes & less(t_min, found.t) & less(found.t, t_max);
      if (met == simd::kAllLanes) break;
    }
    return met;
  }

  const AccelTree& tree_;
  std::span<const Ray* const> rays_;
  PacketRays<F> lanes_;
  EntryPoints points_;
  FewTriangles triangles_;
  bool few_ = false;
};

} // namespace candela::accel_detail
