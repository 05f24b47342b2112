#pragma once

#include "bsdf/fresnel.h"

namespace candela {

/// Reflectance of a metal by two colours: f0 at normal incidence, and `tint` times Schlick's approximation at
/// a cosine of 1/7, about 82 degrees (Kutz, Hasan & Edmondson 2021, "Novel aspects of the Adobe Standard
/// Material", section 2.2; OpenPBR 1.1, "Metal").
struct F82Tint {
  Spectrum f0{0.8f}, tint{1};

  Spectrum operator()(float cosine) const {
    constexpr float kEdge = 1.0f / 7.0f;
    const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
    const Spectrum dip = fresnel_schlick(f0, kEdge) * (Spectrum(1) - tint) / (kEdge * sixth(1 - kEdge));
    return glm::clamp(fresnel_schlick(f0, cosine) - dip * (cosine * sixth(m)), 0.0f, 1.0f);
  }

private:
  static constexpr float sixth(float x) { return sqr(x * x * x); }
};

} // namespace candela
