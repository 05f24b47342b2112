#pragma once
// Into which directions a medium scatters: the list of phase functions. A new one is a file of this folder,
// and its name here; files and panels follow from its rows.

#include "core/variant.h"
#include "media/draine_phase.h"
#include "media/henyey_greenstein_phase.h"
#include "media/isotropic_phase.h"

namespace candela {

using PhaseModel = std::variant<IsotropicPhase, HenyeyGreensteinPhase, RayleighPhase, DropletsPhase>;

namespace detail {

template <class... Models>
std::variant<decltype(std::declval<const Models&>().closure())...>
phase_closures_of(const std::variant<Models...>&);

} // namespace detail

/// Their closures.
using PhaseFunction = decltype(detail::phase_closures_of(std::declval<const PhaseModel&>()));

namespace detail {

template <class... Closures>
constexpr bool are_phase_closures(const std::variant<Closures...>*) {
  return (PhaseClosure<Closures> && ...);
}
static_assert(are_phase_closures(static_cast<const PhaseFunction*>(nullptr)));

} // namespace detail

// As PhaseClosure's members of the same names.

inline float phase_eval(const PhaseFunction& phase, Turn turn) {
  return visit_variant([&](const auto& p) { return p.eval(turn); }, phase);
}
inline Turn phase_sample(const PhaseFunction& phase, float u, float choice) {
  return visit_variant([&](const auto& p) { return p.sample(u, choice); }, phase);
}
inline float mean_cosine(const PhaseFunction& phase) {
  return visit_variant([](const auto& p) { return p.mean_cosine(); }, phase);
}

} // namespace candela
