#pragma once
// What fills the space between surfaces, as one value.

#include "core/variant.h"
#include "media/grid_medium.h"

namespace candela {

/// - transmittance: of the ray's first `distance` (scene units; may be infinite; the ray's direction is of
///   any length). The sampler is for media that estimate it.
/// - estimate_optical_depth: of the first `distance` along a unit direction, or an unbiased estimate.
/// - scatters, emits: whether it does so anywhere.
template <class M>
concept MediumModel = requires(const M& m, const Ray& ray, vec3 v, float distance, const Sampler& sampler,
                               TrackingRandom& random) {
  { m.estimate_optical_depth(v, v, distance, random) } -> std::same_as<Spectrum>;
  { m.transmittance(ray, distance, sampler) } -> std::same_as<TransmittanceEstimate>;
  { m.scatters() } -> std::same_as<bool>;
  { m.emits() } -> std::same_as<bool>;
};

/// All media: a new one is a file of its own, and a name here.
using Medium = std::variant<HomogeneousMedium, GridMedium>;

namespace detail {

template <class... Models>
constexpr bool are_medium_models(const std::variant<Models...>*) {
  return (MediumModel<Models> && ...);
}
static_assert(are_medium_models(static_cast<const Medium*>(nullptr)));

} // namespace detail

// As MediumModel's members of the same names.

inline TransmittanceEstimate transmittance(const Ray& ray, float distance, const Medium& medium,
                                           const Sampler& sampler) {
  return visit_variant([&](const auto& m) { return m.transmittance(ray, distance, sampler); }, medium);
}
inline bool medium_scatters(const Medium& medium) {
  return visit_variant([](const auto& m) { return m.scatters(); }, medium);
}
inline const PhaseFunction& phase_function(const Medium& medium) {
  return visit_variant([](const auto& m) -> const PhaseFunction& { return m.phase; }, medium);
}
inline bool medium_emits(const Medium& medium) {
  return visit_variant([](const auto& m) { return m.emits(); }, medium);
}

} // namespace candela
