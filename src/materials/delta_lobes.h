#pragma once
// All delta lobes of a BSDF, for ray tracing that follows every specular direction instead of sampling one
// (Whitted 1980).

#include "materials/bsdf.h"

#include <array>

namespace candela {

struct DeltaLobe {
  vec3 wi{0}; ///< local, unit
  /// Radiance that leaves along wo for one that arrives from wi (the 1/eta^2 of a refraction included).
  Spectrum transfer{0};
  float eta = 1; ///< as in BsdfSample
};

struct DeltaLobes {
  std::array<DeltaLobe, 2> lobe;
  int count = 0;
};

/// At most a reflection and a refraction. Sampling takes a delta lobe with probability `pdf` and weight
/// transfer / pdf, at u.z near 0 the first one and near 1 the last one.
inline DeltaLobes delta_lobes(const Bsdf& bsdf, vec3 wo) {
  DeltaLobes lobes;
  auto add = [&](const std::optional<BsdfSample>& s) {
    lobes.lobe[static_cast<std::size_t>(lobes.count++)] = {s->wi, s->weight * s->pdf, s->eta};
  };
  auto first = bsdf_sample(bsdf, wo, vec3(0));
  if (first && first->delta) add(first);
  bool reflection_first = first && first->delta && same_hemisphere(wo, first->wi);
  auto last = bsdf_sample(bsdf, wo, vec3(0, 0, std::nextafter(1.0f, 0.0f)));
  if (reflection_first && last && last->delta && !same_hemisphere(wo, last->wi)) add(last);
  return lobes;
}

} // namespace candela
