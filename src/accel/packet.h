#pragma once
// Neighbouring rays, as a camera sends them or as surfaces that it sees send them to a light.
//
// They share the upper part of their way through the tree, which is found once for all of them, with a
// frustum around them (the entry point search of Reshetov, Soupikov and Hurley 2005, "Multi-Level Ray Tracing
// Algorithm", ACM TOG 24(3); here with up to kMaxEntryPoints of them). Where that ends at leaves and the
// frustum hits but few of their triangles, eight rays at a time are tested with each. Else every ray goes on
// alone from the entry points, so that rays that diverge lose nothing. What a ray hits is the same in
// any way: see Packet.
//
// Nanoseconds of a ray alone and in a packet, 512 x 512 pixels, at 1 and at 16 samples a pixel (a busy
// machine: to 10 %):
//
//                               camera rays             their shadow rays
//   Cornell box                 35   9    37  10        31  20     31  19
//   bunny, 69,000 triangles     79  68    61  22        97  87     82  57
//   Sponza, 66,000             118  72   115  42        91  87     74  51
//   sphere, 1.3 million        149 131    70  43       195 197    142 101
//
// The whole render of the Cornell box is 1.10 times as fast where paths do not split, 1.03 times where they
// split in two.
//
// Rays that are no neighbours, too, were tried eight at a time, with all triangles of a Cornell box: 35 ns
// instead of 59 where the lanes are full, but they mostly are not: the whole render is 1.01 to 1.03 times as
// fast, which is not worth it.

#include "accel/packet_frustum.h"
#include "accel/traversal.h"

namespace candela::accel_detail {

/// From 12 to 48, no ray takes 10 % more or less time.
inline constexpr std::size_t kMaxTriangles = 24;

/// Where the rays of a packet begin: subtrees or leaves that hold all that they can hit, the one to enter
/// first last.
struct EntryPoints {
  std::array<Waiting, kMaxEntryPoints> at;
  std::array<ChildPlace, kMaxEntryPoints> place; ///< parallel to at
  std::size_t count = 0;

  std::span<const Waiting> span() const { return {at.data(), count}; }
  void push(const Waiting& child, const ChildPlace& where) { at[count] = child, place[count++] = where; }
  /// The last one takes its place.
  void remove(std::size_t i) { --count, at[i] = at[count], place[i] = place[count]; }
  void sort() {
    for (std::size_t i = 1; i < count; ++i)
      for (std::size_t k = i; k > 0 && at[k - 1].key < at[k].key; --k)
        std::swap(at[k - 1], at[k]), std::swap(place[k - 1], place[k]);
  }
};

enum class Depth {
  above_leaves, ///< no farther than to nodes of which the packet may hit a leaf
  leaves,
};

/// Puts the children that the packet may hit in the place of their nodes, over and over. False where it has
/// to end before it is through, for want of room.
template <class F>
bool descend(const AccelTree& tree, const PacketFrustum<F>& frustum, Depth depth, EntryPoints& points) {
  bool through = true;
  for (std::size_t i = 0; i < points.count;) {
    const ChildRef ref = points.at[i].value;
    if (ref.is_leaf()) {
      ++i;
      continue;
    }
    const WideNode& node = tree.nodes[ref.node()];
    F t_enter;
    const simd::LaneMask lanes_hit = frustum.intersect(node, t_enter);
    bool leaf = false;
    simd::for_each_lane(lanes_hit,
                        [&](int lane) { leaf |= node.child[static_cast<std::size_t>(lane)].is_leaf(); });
    const bool room =
        points.count - 1 + static_cast<std::size_t>(std::popcount(lanes_hit)) <= kMaxEntryPoints;
    if (!room && depth == Depth::leaves) return false;
    if (!room || (leaf && depth == Depth::above_leaves)) {
      through &= room;
      ++i;
      continue;
    }
    points.remove(i);
    alignas(32) std::array<float, kWidth> key;
    t_enter.store(key.data());
    simd::for_each_lane(lanes_hit, [&](int lane) {
      const auto k = static_cast<std::size_t>(lane);
      points.push({node.child[k], key[k]}, {&node, static_cast<std::uint32_t>(lane)});
    });
  }
  points.sort();
  return through;
}

/// The triangles that a packet can hit.
class FewTriangles {
public:
  struct Placed : PackedTriangle {
    ChildPlace leaf; ///< one that it is in
  };

  /// False where they are many, or where the packet can hit something else.
  template <class F>
  bool find(const AccelTree& tree, const EntryPoints& points, const PacketFrustum<F>& frustum) {
    count_ = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
      const ChildRef leaf = points.at[i].value;
      if (leaf.kind() != PrimitiveKind::triangle) return false;
      const TrianglePack& pack = tree.triangles()[leaf.pack()];
      const simd::LaneMask lanes_hit = frustum.intersect(pack);
      if (count_ + static_cast<std::size_t>(std::popcount(lanes_hit)) > kMaxTriangles) return false;
      simd::for_each_lane(lanes_hit, [&](int lane) {
        const auto k = static_cast<std::size_t>(lane);
        insert({{&pack, k, pack.primitive[k]}, points.place[i]});
      });
    }
    return true;
  }
  std::span<const Placed> span() const { return {triangles_.data(), count_}; }

private:
  /// By primitive, so that the first of those at the same t is the one that precedes; once, if it is in two
  /// leaves.
  void insert(const Placed& triangle) {
    const auto end = triangles_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto at =
        std::lower_bound(triangles_.begin(), end, triangle.primitive,
                         [](const Placed& t, std::uint32_t primitive) { return t.primitive < primitive; });
    if (at != end && at->primitive == triangle.primitive) return;
    std::copy_backward(at, end, end + 1);
    *at = triangle;
    ++count_;
  }

  std::array<Placed, kMaxTriangles> triangles_;
  std::size_t count_ = 0;
};

/// Neighbouring rays, of which there is one at least.
///
/// A ray alone hits a leaf only if it hits its box before the closest hit so far. That is no matter but
/// where a triangle is seen nearly edge-on: there t may be off by more than boxes are padded for. So a hit in
/// a leaf that was found with the frustum stands only if the box is hit up to there; then the ray alone would
/// find it, too, and nothing closer. Else it is asked.
template <class F>
class Packet {
public:
  Packet(const AccelTree& tree, std::span<const Ray* const> rays) : tree_(tree), rays_(rays) {
    const bool alike = lanes_.load(rays);
    const auto frustum = PacketFrustum<F>::around(lanes_, tree);
    if (!frustum) return;
    // A leaf is hit only by rays that hit its box, too: where these go on alone, they begin above.
    way_ = Way::subtrees;
    points_.push({tree.root, 0}, {nullptr, 0});
    const bool room = descend(tree, *frustum, Depth::above_leaves, points_);
    EntryPoints leaves = points_;
    if (!room || !descend(tree, *frustum, Depth::leaves, leaves)) return;
    points_ = leaves;
    way_ = alike && triangles_.find(tree, points_, *frustum) ? Way::few_triangles : Way::leaves;
  }

  /// As trace, for all; the t of rays that hit nothing becomes infinite.
  void intersect(std::span<Hit> hits) const {
    if (way_ == Way::few_triangles) {
      for (std::size_t group = 0; group < lanes_.groups; ++group) intersect_few(group, hits);
      return;
    }
    for (std::size_t i = 0; i < rays_.size(); ++i)
      if (!trace_one<false>(*rays_[i], hits[i])) hits[i].t = kInfinity;
  }
  void occluded(std::span<bool> result) const {
    if (way_ == Way::few_triangles) {
      for (std::size_t group = 0; group < lanes_.groups; ++group) occlude_few(group, result);
      return;
    }
    Hit unused;
    for (std::size_t i = 0; i < rays_.size(); ++i) result[i] = trace_one<true>(*rays_[i], unused);
  }

  enum class Way {
    few_triangles, ///< eight rays at a time with each of them
    leaves,        ///< each ray with each leaf
    subtrees,      ///< each ray from there
    root,          ///< the rays are no neighbours
  };
  Way way() const { return way_; }
  std::size_t triangle_count() const { return triangles_.span().size(); }
  std::size_t entry_point_count() const { return points_.count; }

private:
  /// Whether the ray hits the box before t_max.
  bool hits_box(const Ray& ray, const ChildPlace& place, float t_max) const {
    if (place.node == nullptr) return true;
    F unused;
    const simd::LaneMask lanes_hit =
        BoxRay<F>(ray, tree_).intersect(*place.node, F(std::max(ray.t_min, 0.0f)), F(t_max), unused);
    return lanes_hit >> place.lane & 1;
  }

  template <bool any_hit>
  bool trace_one(const Ray& ray, Hit& hit) const {
    NoCost no_cost;
    if (way_ == Way::subtrees && points_.count == 0) return false;
    if (way_ == Way::subtrees) return trace_subtrees<F, any_hit>(tree_, points_.span(), ray, hit, no_cost);
    if (way_ == Way::leaves) {
      std::size_t last = 0;
      if (!trace_leaves<F, any_hit>(tree_, points_.span(), ray, hit, last)) return false;
      if (hits_box(ray, points_.place[last], any_hit ? ray.t_max : hit.t)) return true;
    }
    return trace<F, any_hit>(tree_, ray, hit);
  }

  void intersect_few(std::size_t group, std::span<Hit> hits) const {
    const std::size_t first = group * kWidth;
    const ShearedRay<F> ray = lanes_.group(group);
    const BoxRays<F> box_rays(lanes_, group, tree_);
    const F t_min = F::load(&lanes_.t_min[first]);
    F t_max = F::load(&lanes_.t_max[first]), u(0.0f), v(0.0f), primitive(0.0f);
    simd::LaneMask lanes_hit = 0, stands = 0;
    for (const FewTriangles::Placed& triangle : triangles_.span()) {
      const TriangleHits<F> found(triangle, ray);
      if (!found.lanes) continue;
      const simd::LaneMask closer = found.lanes & less(t_min, found.t) & less(found.t, t_max);
      if (!closer) continue;
      lanes_hit |= closer;
      stands = (stands & ~closer) | (closer & box_rays.intersect(triangle.leaf, t_min, found.t));
      const F inverse = F(1.0f) / found.determinant;
      t_max = select_lanes(closer, found.t, t_max);
      u = select_lanes(closer, found.edge.v * inverse, u);
      v = select_lanes(closer, found.edge.w * inverse, v);
      primitive = select_lanes(closer, F(std::bit_cast<float>(triangle.primitive)), primitive);
    }
    alignas(32) std::array<float, kWidth> ts, us, vs, primitives;
    select_lanes(lanes_hit, t_max, F(kInfinity)).store(ts.data());
    u.store(us.data()), v.store(vs.data()), primitive.store(primitives.data());
    for (std::size_t k = 0; k < std::min<std::size_t>(kWidth, rays_.size() - first); ++k) {
      Hit& hit = hits[first + k];
      hit = {ts[k],       us[k],
             vs[k],       std::bit_cast<std::uint32_t>(primitives[k]),
             kNoInstance, PrimitiveKind::triangle};
      if (((lanes_hit & ~stands) >> k & 1) && !trace<F, false>(tree_, *rays_[first + k], hit))
        hit.t = kInfinity;
    }
  }

  void occlude_few(std::size_t group, std::span<bool> result) const {
    const std::size_t first = group * kWidth;
    const ShearedRay<F> ray = lanes_.group(group);
    const F t_min = F::load(&lanes_.t_min[first]), t_max = F::load(&lanes_.t_max[first]);
    std::optional<BoxRays<F>> box_rays;
    simd::LaneMask lanes_hit = 0, stands = 0;
    for (const FewTriangles::Placed& triangle : triangles_.span()) {
      const TriangleHits<F> found(triangle, ray);
      if (!found.lanes) continue;
      const simd::LaneMask hit = found.lanes & less(t_min, found.t) & less(found.t, t_max);
      if (!(hit & ~stands)) continue;
      lanes_hit |= hit;
      if (!box_rays) box_rays.emplace(lanes_, group, tree_);
      stands |= hit & box_rays->intersect(triangle.leaf, t_min, t_max);
      if (stands == simd::kAllLanes) break;
    }
    for (std::size_t k = 0; k < std::min<std::size_t>(kWidth, rays_.size() - first); ++k) {
      Hit unused;
      result[first + k] =
          (stands >> k & 1) || ((lanes_hit >> k & 1) && trace<F, true>(tree_, *rays_[first + k], unused));
    }
  }

  const AccelTree& tree_;
  std::span<const Ray* const> rays_;
  PacketRays<F> lanes_;
  EntryPoints points_;
  FewTriangles triangles_;
  Way way_ = Way::root;
};

} // namespace candela::accel_detail
