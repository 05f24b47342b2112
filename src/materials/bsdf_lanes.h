#pragma once
// Closures of many hits at once, those of one type after another.

#include "materials/direction_sampling.h"

#include <cstdint>
#include <span>

namespace candela {

namespace detail {

/// f(closure, k) for the k whose closure is the I-th alternative. A function of its own, into which all of
/// the closure is inlined.
template <std::size_t I, class F>
[[gnu::noinline, gnu::flatten]] void visit_type(std::span<const Bsdf* const> bsdfs, const F& f) {
  for (std::size_t k = 0; k < bsdfs.size(); ++k)
    if (const auto* closure = std::get_if<I>(bsdfs[k])) f(*closure, k);
}

template <class F, std::size_t... I>
void visit_types(std::span<const Bsdf* const> bsdfs, const F& f, std::index_sequence<I...>) {
  static_assert(sizeof...(I) <= 64);
  std::uint64_t present = 0;
  for (const Bsdf* bsdf : bsdfs) present |= std::uint64_t{1} << bsdf->index();
  ((present >> I & 1 ? visit_type<I>(bsdfs, f) : void()), ...);
}

} // namespace detail

/// f(closure, k) for all of bsdfs[k], type by type as in Laine et al. 2013, "Megakernels considered harmful":
/// each type has a loop of its own, whose registers and branches the others do not disturb, however many
/// there are. The calls are not in the order of k.
template <class F>
void for_each_closure(std::span<const Bsdf* const> bsdfs, const F& f) {
  detail::visit_types(bsdfs, f, std::make_index_sequence<std::variant_size_v<Bsdf>>());
}

/// out(k, sample_direction()) of each closure: wo(k) is its direction, u(k) its random numbers.
template <class Wo, class U, class Out>
void sample_directions(std::span<const Bsdf* const> bsdfs, DirectionSampling how, const Wo& wo, const U& u,
                       const Out& out) {
  if (how != DirectionSampling::bsdf) {
    for (std::size_t k = 0; k < bsdfs.size(); ++k) out(k, sample_direction(*bsdfs[k], wo(k), u(k), how));
    return;
  }
  for_each_closure(bsdfs, [&](const auto& closure, std::size_t k) {
    out(k, detail::closure_sample(closure, wo(k), u(k), TransportMode::radiance));
  });
}

} // namespace candela
