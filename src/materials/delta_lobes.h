#pragma once
// All delta lobes of a BSDF, for ray tracing that follows every specular direction instead of sampling one
// (Whitted 1980).

#include "materials/blend_parts.h"

#include <algorithm>
#include <array>

namespace candela {

struct DeltaLobe {
  vec3 wi{0}; ///< local, unit
  /// Radiance that leaves along wo for one that arrives from wi (the 1/eta^2 of a refraction included).
  Spectrum transfer{0};
  float eta = 1; ///< as in BsdfSample
};

/// Of a mixture: a refraction of each part, and the reflection, which all have in common.
inline constexpr std::size_t kMostDeltaLobes = kMostBlendParts + 1;

struct DeltaLobes {
  std::array<DeltaLobe, kMostDeltaLobes> lobe;
  int count = 0;
};

namespace detail {

/// Of one model: at most a reflection and a refraction. Sampling takes a delta lobe with probability `pdf`
/// and weight transfer / pdf, at u.z near 0 the first one and near 1 the last one.
inline DeltaLobes model_delta_lobes(const Bsdf& bsdf, vec3 wo) {
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

} // namespace detail

/// All of them, those of mixtures and of their parts included.
inline DeltaLobes delta_lobes(const Bsdf& bsdf, vec3 wo) {
  const auto* blend = std::get_if<Blend>(&bsdf);
  if (blend == nullptr) return detail::model_delta_lobes(bsdf, wo);
  DeltaLobes all;
  for (const BlendPart& part : std::span(blend->parts, blend->count)) {
    const DeltaLobes own = detail::model_delta_lobes(part.bsdf, wo);
    for (const DeltaLobe& lobe : std::span(own.lobe.data(), static_cast<std::size_t>(own.count))) {
      const auto known = std::span(all.lobe.data(), static_cast<std::size_t>(all.count));
      auto same = std::ranges::find_if(known, [&](const DeltaLobe& k) {
        return k.wi == lobe.wi || (same_hemisphere(wo, k.wi) && same_hemisphere(wo, lobe.wi));
      });
      if (same == known.end()) {
        all.lobe[static_cast<std::size_t>(all.count++)] = {lobe.wi, part.weight * lobe.transfer, lobe.eta};
        continue;
      }
      same->transfer += part.weight * lobe.transfer;
    }
  }
  return all;
}

} // namespace candela
