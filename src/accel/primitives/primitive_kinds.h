#pragma once
// The list of primitive kinds. A new kind is a file in this folder and an entry here, at the end of both
// lists; bounds, splits, packs, intersection, occlusion, statistics and memory follow from it.
//
// A kind is a struct of static members (see PrimitiveKindModel):
//
// - Input: the fields that it adds to AccelInput.
// - Pack: up to kLeafCapacity primitives as they lie in memory.
// - kLeafCost: of testing a pack, in node visits, for the surface area heuristic.
// - count, bounds: of the input; empty bounds leave a primitive out.
// - fill: makes a pack.
// - intersect: the lanes of a pack that a ray hits with t in (t_min, t_max), and their t; all of them, or
//   those of least t. A template over the SIMD implementation.
// - occluded: optional, whether there are any. Without it, intersect is asked.
// - parameters: Hit::u and v of the lane that is the closest hit.
// - cut: optional, the boxes of the parts on both sides of a plane. Kinds with it take part in spatial
//   splits.
//
// Triangles have no intersect, for the traversal tests them itself, in registers. Kinds of instances have
// object_ray() instead, which gives a ray in the space of the object, and the traversal enters its tree.

#include "accel/primitives/curves.h"
#include "accel/primitives/discs.h"
#include "accel/primitives/instances.h"
#include "accel/primitives/moving_instances.h"
#include "accel/primitives/moving_triangles.h"
#include "accel/primitives/spheres.h"
#include "accel/primitives/triangles.h"

#include <concepts>
#include <tuple>

namespace candela {

/// In the order of PrimitiveKinds. Of hits at the same t, the lower kind is found.
enum class PrimitiveKind : std::uint32_t {
  triangle,
  sphere,
  disc,
  instance,
  curve,
  moving_instance,
  moving_triangle
};

namespace accel_detail {

template <class Kind>
concept PrimitiveKindModel = requires(typename Kind::Pack& pack, const typename Kind::Input& input,
                                      std::size_t i, std::span<const std::uint32_t> indices) {
  { Kind::kLeafCapacity } -> std::convertible_to<std::uint32_t>;
  { Kind::kLeafCost } -> std::convertible_to<float>;
  { Kind::count(input) } -> std::same_as<std::size_t>;
  { Kind::bounds(input, i) } -> std::same_as<Bounds3>;
  Kind::fill(pack, input, indices);
};

template <PrimitiveKindModel... Kinds>
struct PrimitiveKindList {
  static constexpr std::size_t kCount = sizeof...(Kinds);
  struct Input : Kinds::Input... {};

  template <class Kind>
  static constexpr PrimitiveKind kind_of = [] {
    std::uint32_t index = 0;
    (void)((std::is_same_v<Kind, Kinds> || (++index, false)) || ...);
    return static_cast<PrimitiveKind>(index);
  }();

  /// Calls f.operator()<Kind>() for each, in order.
  template <class Function>
  static constexpr void for_each(Function&& f) {
    (f.template operator()<Kinds>(), ...);
  }
  /// f.operator()<Kind>() of one; false for a number that is none.
  template <class Function>
  static constexpr bool visit(PrimitiveKind kind, Function&& f) {
    bool result = false;
    (void)((kind == kind_of<Kinds> && (result = f.template operator()<Kinds>(), true)) || ...);
    return result;
  }
  /// Vectors of their packs, one per kind.
  template <template <class> class Vector>
  using Storage = std::tuple<Vector<typename Kinds::Pack>...>;

  static constexpr std::array<std::uint32_t, kCount> kLeafCapacity{Kinds::kLeafCapacity...};
  static constexpr std::array<float, kCount> kLeafCost{Kinds::kLeafCost...};
};

using PrimitiveKinds =
    PrimitiveKindList<primitives::Triangles, primitives::Spheres, primitives::Discs, primitives::Instances,
                      primitives::Curves, primitives::MovingInstances, primitives::MovingTriangles>;

static_assert(PrimitiveKinds::kind_of<primitives::Triangles> == PrimitiveKind::triangle);
static_assert(PrimitiveKinds::kind_of<primitives::Spheres> == PrimitiveKind::sphere);
static_assert(PrimitiveKinds::kind_of<primitives::Discs> == PrimitiveKind::disc);
static_assert(PrimitiveKinds::kind_of<primitives::Instances> == PrimitiveKind::instance);
static_assert(PrimitiveKinds::kind_of<primitives::Curves> == PrimitiveKind::curve);
static_assert(PrimitiveKinds::kind_of<primitives::MovingInstances> == PrimitiveKind::moving_instance);
static_assert(PrimitiveKinds::kind_of<primitives::MovingTriangles> == PrimitiveKind::moving_triangle);

inline constexpr auto kNoPart = [](simd::Vec4, simd::Vec4) {};

/// Whether primitives of the kind may be referenced on both sides of a spatial split.
template <class Kind>
concept CuttableKind = requires(const typename Kind::Input& input) {
  Kind::cut(input, 0u, std::size_t{0}, 0.0f, kNoPart, kNoPart);
};

/// Whether primitives of the kind are objects with trees of their own, each a pack.
template <class Kind>
concept ObjectKind = requires(const typename Kind::Pack& pack, const Ray& ray) {
  { Kind::object_ray(pack, ray, 0.0f) } -> std::same_as<Ray>;
};

constexpr std::size_t number(PrimitiveKind kind) { return static_cast<std::size_t>(kind); }

/// How many of something there are of each kind.
template <class T>
using PerKind = std::array<T, PrimitiveKinds::kCount>;

} // namespace accel_detail

/// What to build from: the inputs of all kinds. Nothing is referenced after the build but the objects of
/// instances.
struct AccelInput : accel_detail::PrimitiveKinds::Input {};

} // namespace candela
