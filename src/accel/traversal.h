#pragma once
// Tracing a ray through the wide tree. A template over the SIMD implementation: the library instantiates it
// for the best one, the tests also for the portable one.

#include "accel/intersect.h"
#include "accel/layout.h"

namespace candela::accel_detail {

/// A ray prepared for box tests that never miss what the triangle test would hit.
///
/// The triangle test moves vertices, relative to the ray, by up to 6 eps times the distance from the origin
/// to the farthest vertex along any axis (eps = 2^-24: subtraction 1, shear 3, sum 2); hence boxes grow by 8
/// eps of it. The padding rides on the origin, whose own rounding the second term covers. Slab distances have
/// three roundings each, which the factors on the inverse direction cover (pbrt-v4, section 6.8.2; Ize 2013,
/// "Robust BVH Ray Traversal", JCGT 2(2)). So all of this costs nothing per node.
template <class F>
struct BoxRay {
  std::array<F, 3> origin_near, origin_far, inverse_near, inverse_far;
  /// Index into WideNode::box[axis]: 1 where the ray points down the axis.
  std::array<std::size_t, 3> near_side;

  BoxRay(const Ray& ray, const AccelTree& tree) {
    // Three axes at a time: scalar code took a tenth of the time of a ray in the Cornell box.
    using simd::Vec4;
    Vec4 o{ray.origin.x, ray.origin.y, ray.origin.z, 0},
        d{ray.direction.x, ray.direction.y, ray.direction.z, 1};
    Vec4 reach = simd::max4(simd::abs4(tree.lower - o), simd::abs4(tree.upper - o));
    float pad = std::max(std::max(reach[0], reach[1]), reach[2]) * 0x1p-21f;
    Vec4 shift = simd::copysign4(pad + simd::abs4(o) * 0x1p-22f, d);
    Vec4 inverse = 1 / d;
    Vec4 o_near = o + shift, o_far = o - shift;
    Vec4 i_near = inverse * (1 - gamma_bound(5)), i_far = inverse * (1 + gamma_bound(5));
    for (int axis = 0; axis < 3; ++axis) {
      auto i = static_cast<std::size_t>(axis);
      near_side[i] = std::signbit(ray.direction[axis]);
      origin_near[i] = F(o_near[axis]), origin_far[i] = F(o_far[axis]);
      inverse_near[i] = F(i_near[axis]), inverse_far[i] = F(i_far[axis]);
    }
  }

  /// The children whose boxes the ray hits in [t_min, t_max], and where it enters them. With a direction
  /// component of 0 a distance may be 0 * inf = NaN, on the very plane; min and max then take their second
  /// operand, which counts the slab as hit.
  simd::LaneMask intersect(const WideNode& node, F t_min, F t_max, F& t_enter) const {
    F enter = t_min, leave = t_max;
    for (std::size_t i = 3; i-- > 0;) {
      F near_plane = F::load(node.box[i][near_side[i]].data());
      F far_plane = F::load(node.box[i][near_side[i] ^ 1].data());
      enter = max((near_plane - origin_near[i]) * inverse_near[i], enter);
      leave = min((far_plane - origin_far[i]) * inverse_far[i], leave);
    }
    t_enter = enter;
    return less_equal(enter, leave);
  }
};

/// A child that waits to be visited.
using Waiting = simd::Keyed<ChildRef>;

/// Counts nothing, at no cost.
struct NoCost {
  struct Sink {
    void operator++() {}
  };
  Sink nodes, packs;
};

template <class F, bool any_hit, class Cost>
bool trace(const AccelTree& tree, const Ray& ray, Hit& hit, Cost& cost);

/// A leaf of any kind but triangles; out of line, for the registers belong to triangles. As
/// intersect_triangles, but t_max is the caller's to lower.
template <class F, bool any_hit, class Cost>
[[gnu::noinline]] bool intersect_other_leaf(const AccelTree& tree, const Ray& ray, ChildRef leaf, float t_min,
                                            float t_max, Hit& hit, Cost& cost) {
  if constexpr (!any_hit) // what is as far as the hit so far is to be compared with it
    if (t_max == hit.t) t_max = std::nextafter(t_max, kInfinity);
  auto accept = [&hit](const Hit& found) {
    if (found.t == hit.t && !precedes(found, hit)) return false;
    hit = found;
    return true;
  };
  return PrimitiveKinds::visit(leaf.kind(), [&]<class Kind>() {
    if constexpr (std::is_same_v<Kind, primitives::Triangles>) {
      return false;
    } else if constexpr (ObjectKind<Kind>) {
      const typename Kind::Pack& instance = tree.packs<Kind>()[leaf.pack()];
      const Ray local = Kind::object_ray(instance, ray, t_max);
      Hit found;
      if (!trace<F, any_hit>(*instance.object, local, found, cost)) return false;
      if constexpr (any_hit) return true;
      found.instance = instance.index;
      return accept(found);
    } else {
      const typename Kind::Pack& pack = tree.packs<Kind>()[leaf.pack()];
      if constexpr (any_hit && requires { Kind::template occluded<F>(pack, ray, t_min, t_max); })
        return Kind::template occluded<F>(pack, ray, t_min, t_max);
      LaneHits lanes;
      Kind::template intersect<F>(pack, ray, t_min, t_max, lanes);
      if (any_hit || !lanes.lanes) return lanes.lanes != 0;
      const std::size_t lane = closest_lane(lanes.lanes, lanes.t, pack.primitive);
      const vec2 uv = Kind::parameters(pack, lane, ray, lanes);
      return accept(
          {lanes.t[lane], uv.x, uv.y, pack.primitive[lane], kNoInstance, PrimitiveKinds::kind_of<Kind>});
    }
  });
}

/// As trace, for a ray that can hit nothing but these leaves; no boxes, no stack. `last` becomes the index
/// of the one that hit is in.
template <class F, bool any_hit>
bool trace_leaves(const AccelTree& tree, std::span<const Waiting> leaves, const Ray& ray, Hit& hit,
                  std::size_t& last) {
  const ShearedRay<F> sheared(ray);
  const float t_min = std::max(ray.t_min, 0.0f);
  float t_max = ray.t_max;
  if constexpr (!any_hit) hit.t = std::numeric_limits<float>::quiet_NaN(); // see precedes
  bool found = false;
  NoCost no_cost;
  for (std::size_t i = leaves.size(); i-- > 0 && leaves[i].key <= t_max;) {
    const ChildRef leaf = leaves[i].value;
    if (leaf.kind() == PrimitiveKind::triangle) {
      if (!intersect_triangles<F, any_hit>(tree.triangles()[leaf.pack()], sheared, t_min, t_max, hit))
        continue;
    } else {
      if (!intersect_other_leaf<F, any_hit>(tree, ray, leaf, t_min, t_max, hit, no_cost)) continue;
      if constexpr (!any_hit) t_max = hit.t;
    }
    found = true, last = i;
    if constexpr (any_hit) break;
  }
  return found;
}

/// As trace, for a ray that can hit nothing but these subtrees of the tree, of which there is one at least.
/// The last is entered first.
template <class F, bool any_hit, class Cost>
[[gnu::always_inline]] inline bool trace_subtrees(const AccelTree& tree, std::span<const Waiting> subtrees,
                                                  const Ray& ray, Hit& hit, Cost& cost) {
  const ShearedRay<F> sheared(ray);
  const float t_min = std::max(ray.t_min, 0.0f);
  float t_max = ray.t_max;
  if constexpr (!any_hit) hit.t = std::numeric_limits<float>::quiet_NaN(); // see precedes
  bool found = false;
  auto intersect_leaf = [&](ChildRef leaf) __attribute__((always_inline)) {
    ++cost.packs;
    if (leaf.kind() == PrimitiveKind::triangle) [[likely]]
      return intersect_triangles<F, any_hit>(tree.triangles()[leaf.pack()], sheared, t_min, t_max, hit);
    if (!intersect_other_leaf<F, any_hit>(tree, ray, leaf, t_min, t_max, hit, cost)) return false;
    if constexpr (!any_hit) t_max = hit.t;
    return true;
  };

  // NaN would hit every box and walk the whole tree.
  vec3 sum = ray.origin + ray.direction;
  if (!std::isfinite(sum.x + sum.y + sum.z)) return false;
  const BoxRay<F> box_ray(ray, tree);
  const F t_min8(t_min);
  const WideNode* nodes = tree.nodes.data();
  std::array<Waiting, kStackSize> stack;
  std::copy(subtrees.begin(), subtrees.end() - 1, stack.begin());
  Waiting* top = stack.data() + subtrees.size() - 1;
  ChildRef current = subtrees.back().value;
  for (;;) {
    if (current.is_leaf()) {
      if (intersect_leaf(current)) {
        if constexpr (any_hit) return true;
        found = true;
      }
    } else {
      ++cost.nodes;
      const WideNode& node = nodes[current.node()];
      F t_enter;
      simd::LaneMask lanes = box_ray.intersect(node, t_min8, F(t_max), t_enter);
      if (lanes) {
        if ((lanes & (lanes - 1)) == 0) {
          current = node.child[static_cast<std::size_t>(std::countr_zero(lanes))];
        } else if constexpr (any_hit) {
          // Any hit will do, so the order needs no sorting: 6 to 12 % of the time of a shadow ray.
          current = simd::take_first(t_enter, node.child, lanes, top);
          top += std::popcount(lanes) - 1;
        } else {
          top += simd::store_descending(t_enter, node.child, lanes, top) - 1;
          current = top->value;
        }
        continue;
      }
    }
    do {
      if (top == stack.data()) return found;
      --top;
    } while (top->key > t_max);
    current = top->value;
  }
}

/// Whether the ray hits something in (max(ray.t_min, 0), ray.t_max). For the closest hit, sets
/// hit. `cost` is a TraversalCost or a NoCost.
template <class F, bool any_hit, class Cost>
bool trace(const AccelTree& tree, const Ray& ray, Hit& hit, Cost& cost) {
  const Waiting root{tree.root, 0};
  return trace_subtrees<F, any_hit>(tree, {&root, 1}, ray, hit, cost);
}

template <class F, bool any_hit>
bool trace(const AccelTree& tree, const Ray& ray, Hit& hit) {
  NoCost no_cost;
  return trace<F, any_hit>(tree, ray, hit, no_cost);
}

} // namespace candela::accel_detail
