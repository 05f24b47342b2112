#pragma once
// What shading needs of the primitives of a kind (accel/primitives): one file each, NAME_surfaces.h.

#include "accel/accel.h"
#include "core/progress.h"
#include "render/world/surface_interaction.h"
#include "scene/scene_desc.h"

#include <tuple>

namespace candela {

/// All primitives of a kind that a scene has, and what they are surfaces of. Hits given to it are of its
/// kind.
///
/// - Primitives: its kind in accel/primitives.
/// - count: those that could emit, which are numbered from 0.
/// - material_of, instance_of: index into SceneDesc::materials, and into the instances that were built from.
/// - number_of: of the primitive that was hit, among `count`.
/// - set_surface: all of the interaction but material and emitter.
/// - uv, tangents: as Geometry's.
/// - hit_at: the hit of a ray from the point on the primitive of that number, with t = 0.
/// - for_each_light(emits, add, progress): for each light that surfaces are of which emits(material), calls
///   add(number, count, material, make): of `count` primitives from that number on, make(an EmitterRadiance)
///   being a light of lights/, or an optional one: without it only rays that meet the surface find it.
///
/// Optional, of kinds that shapes become directly:
///
/// - add(instance, index): whether the instance is made of this kind; then it is added.
/// - input: for the build of the tree.
///
/// Optional, of kinds that meshes become: smooth_triangle, if they may be smooth, and triangle_of_instance,
/// as Geometry's.
template <class K>
concept SurfaceKind = requires(const K& k, const Ray& ray, const Hit& hit, SurfaceInteraction& s,
                               std::uint64_t number, vec3 point) {
  typename K::Primitives;
  { k.count() } -> std::same_as<std::uint64_t>;
  { k.material_of(hit) } -> std::same_as<std::uint32_t>;
  { k.instance_of(hit) } -> std::same_as<std::uint32_t>;
  { k.number_of(hit) } -> std::same_as<std::uint64_t>;
  k.set_surface(ray, hit, s);
  { k.uv(ray, hit) } -> std::same_as<vec2>;
  { k.tangents(ray, hit) } -> std::same_as<SurfaceTangents>;
  { k.hit_at(number, point) } -> std::same_as<Hit>;
  { k.memory_bytes() } -> std::same_as<std::size_t>;
};

/// The surfaces of each kind, in the order of PrimitiveKind. Primitives that could emit are numbered through
/// all kinds in this order.
template <SurfaceKind... Kinds>
class SurfaceKindList {
public:
  template <class Kind>
  const Kind& of() const {
    return std::get<Kind>(kinds_);
  }
  template <class Kind>
  Kind& of() {
    return std::get<Kind>(kinds_);
  }

  /// Calls f(surfaces, number of their first primitive) for each kind.
  template <class F>
  void for_each(F f) const {
    std::size_t i = 0;
    (f(of<Kinds>(), first_[i++]), ...);
  }
  /// f(surfaces) of each.
  template <class F>
  void change_each(F f) {
    (f(of<Kinds>()), ...);
  }
  /// Once all are there.
  void number_primitives() {
    std::size_t i = 0;
    ((first_[i + 1] = first_[i] + of<Kinds>().count(), ++i), ...);
  }
  std::uint64_t count() const { return first_.back(); }

  /// f(surfaces, number of their first primitive) of the kind that was hit.
  template <class F>
  [[gnu::always_inline]] decltype(auto) visit(const Hit& hit, F&& f) const {
    if (hit.instance == kNoInstance) return visit_from<0>(hit.kind, f);
    return visit_from<0>(
        (hit.instance & kMovingInstance) == 0 ? PrimitiveKind::instance : PrimitiveKind::moving_instance, f);
  }
  /// The same of the kind that a number belongs to, which is below count().
  template <class F>
  decltype(auto) visit(std::uint64_t number, F&& f) const {
    std::size_t kind = 0;
    while (number >= first_[kind + 1]) ++kind;
    return visit_from<0>(static_cast<PrimitiveKind>(kind), f);
  }

private:
  static constexpr std::size_t kCount = sizeof...(Kinds);
  static_assert(std::is_same_v<accel_detail::PrimitiveKindList<typename Kinds::Primitives...>,
                               accel_detail::PrimitiveKinds>,
                "every primitive kind has its surfaces, in the same order");

  template <std::size_t I, class F>
  [[gnu::always_inline]] decltype(auto) visit_from(PrimitiveKind kind, F& f) const {
    if constexpr (I + 1 < kCount) {
      if (accel_detail::number(kind) != I) return visit_from<I + 1>(kind, f);
    }
    return f(std::get<I>(kinds_), first_[I]);
  }

  std::tuple<Kinds...> kinds_;
  std::array<std::uint64_t, kCount + 1> first_{};
};

} // namespace candela
