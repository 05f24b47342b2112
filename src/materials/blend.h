#pragma once
// The mixture of several closures.

#include "bsdf/bsdf_sample.h"

#include <cstdint>

namespace candela {

struct BlendPart; // materials/blend_parts.h: it holds a closure of any type, so one of this type, too

/// f = sum_i w_i f_i, with weights w_i that add up to 1. It is sampled by its parts in proportion to their
/// weights, with the density of the whole mixture: p = sum_i w_i p_i (Veach 1997, section 9.2.4, one-sample
/// model with the balance heuristic). Delta lobes come first, as of all closures. All parts have the same
/// normal. Without parts it absorbs all light.
struct Blend {
  BlendPart* parts = nullptr; ///< a BlendArena's
  std::uint32_t count = 0;

  Spectrum eval(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const;
  float pdf(vec3 wo, vec3 wi) const;
  BsdfEval eval_pdf(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const;
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) const;
  float delta_probability(vec3 wo) const;
  BsdfFlags flags() const;
  LobeProxy lobe_proxy(vec3 wo) const;
  Spectrum albedo() const;

  // Of the parts; changes are of those that the pointer names.
  bool is_anisotropic() const;
  void set_tangent(vec2 tangent);
  void set_outside_ior(float outside);
  void set_fibre_offset(float h);
};

} // namespace candela
