#include "materials/blend.h"

#include "materials/blend_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace candela {

namespace {

std::span<BlendPart> parts_of(const Blend& blend) { return {blend.parts, blend.count}; }

/// The probabilities of delta lobes: of each part, and of the mixture.
struct DeltaShares {
  std::array<float, kMostBlendParts> of{};
  float all = 0;

  DeltaShares(const Blend& blend, vec3 wo) {
    bool only_delta = blend.count > 0;
    for (std::size_t i = 0; i < blend.count; ++i) {
      const BlendPart& part = blend.parts[i];
      of[i] = bsdf_delta_probability(part.bsdf, wo);
      all += part.weight * of[i];
      only_delta &= of[i] >= 1;
    }
    all = only_delta ? 1.0f : std::min(all, 1.0f); // though weights add up to nearly 1
  }
};

} // namespace

Spectrum Blend::eval(vec3 wo, vec3 wi, TransportMode mode) const {
  Spectrum sum(0);
  for (const BlendPart& part : parts_of(*this)) sum += part.weight * bsdf_eval(part.bsdf, wo, wi, mode);
  return sum;
}

float Blend::pdf(vec3 wo, vec3 wi) const {
  float sum = 0;
  for (const BlendPart& part : parts_of(*this)) sum += part.weight * bsdf_pdf(part.bsdf, wo, wi);
  return sum;
}

BsdfEval Blend::eval_pdf(vec3 wo, vec3 wi, TransportMode mode) const {
  BsdfEval sum{Spectrum(0), 0};
  for (const BlendPart& part : parts_of(*this)) {
    const BsdfEval e = bsdf_eval_pdf(part.bsdf, wo, wi, mode);
    sum.f_cos += part.weight * e.f_cos;
    sum.pdf += part.weight * e.pdf;
  }
  return sum;
}

std::optional<BsdfSample> Blend::sample(vec3 wo, BsdfU u, TransportMode mode) const {
  const DeltaShares delta(*this, wo);
  const bool takes_delta = u.lobe < delta.all;
  // The part by what is left of u.lobe, which then is uniform again within the part's share of [0, 1).
  float left = takes_delta ? u.lobe : u.lobe - delta.all;
  const BlendPart* chosen = nullptr;
  float from = 0, to = 0, at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float begin = takes_delta ? 0 : delta.of[i], end = takes_delta ? delta.of[i] : 1;
    const float share = parts[i].weight * (end - begin);
    if (!(share > 0)) continue;
    chosen = &parts[i]; // the last one takes what rounding leaves
    from = begin, to = end, at = begin + left / parts[i].weight;
    if (left < share) break;
    left -= share;
  }
  if (chosen == nullptr) return std::nullopt;
  at = std::clamp(at, from, std::nextafter(to, 0.0f));
  std::optional<BsdfSample> s = bsdf_sample(chosen->bsdf, wo, BsdfU(u.disc, at), mode);
  if (!s) return std::nullopt;
  if (s->delta) {
    s->pdf *= chosen->weight; // f and the probability both have it, so the weight stays
    return s;
  }
  const BsdfEval e = eval_pdf(wo, s->wi, mode);
  if (!(e.pdf > 0)) return std::nullopt;
  s->weight = e.f_cos / e.pdf;
  s->pdf = e.pdf;
  return s;
}

float Blend::delta_probability(vec3 wo) const { return DeltaShares(*this, wo).all; }

BsdfFlags Blend::flags() const {
  BsdfFlags all = count > 1 ? BsdfFlags::mixed : BsdfFlags::none;
  for (const BlendPart& part : parts_of(*this)) all |= bsdf_flags(part.bsdf);
  return all;
}

/// The parts' lobes as one, of their albedo and their mean sharpness.
LobeProxy Blend::lobe_proxy(vec3 wo) const {
  LobeProxy sum{0, 0, 0};
  float albedo_sum = 0;
  for (const BlendPart& part : parts_of(*this)) {
    const LobeProxy p = bsdf_lobe_proxy(part.bsdf, wo);
    const float lobe = part.weight * p.lobe_albedo();
    sum.diffuse += part.weight * p.diffuse;
    sum.sharpness += lobe * p.sharpness;
    albedo_sum += lobe;
  }
  if (albedo_sum > 0) {
    sum.sharpness /= albedo_sum;
    sum.peak = albedo_sum * (1 + sum.sharpness) / (2 * kPi);
  }
  return sum;
}

Spectrum Blend::albedo() const {
  Spectrum sum(0);
  for (const BlendPart& part : parts_of(*this)) sum += part.weight * bsdf_albedo(part.bsdf);
  return sum;
}

bool Blend::is_anisotropic() const {
  return std::ranges::any_of(parts_of(*this),
                             [](const BlendPart& part) { return candela::is_anisotropic(part.bsdf); });
}
void Blend::set_tangent(vec2 tangent) {
  for (BlendPart& part : parts_of(*this)) candela::set_tangent(part.bsdf, tangent);
}
void Blend::set_outside_ior(float outside) {
  for (BlendPart& part : parts_of(*this)) candela::set_outside_ior(part.bsdf, outside);
}
void Blend::set_fibre_offset(float h) {
  for (BlendPart& part : parts_of(*this)) candela::set_fibre_offset(part.bsdf, h);
}

} // namespace candela
