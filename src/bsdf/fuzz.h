#pragma once

#include "sampling/warp.h"

namespace candela {

/// A layer of fibres that absorb nothing, as a lobe of f |cos theta_i| = albedo * density:
///   Zeltner, Burley & Chiang 2022, "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines".
/// The density is a cosine lobe, linearly transformed. Its two coefficients and the albedo are functions of
/// cos theta_o and the roughness, for which MaterialX has fitted the formulas below to the authors' tables
/// (libraries/pbrlib, mx_microfacet_sheen). Not reciprocal. Directions are above the surface.
class Fuzz {
public:
  /// roughness: 0 fibres that stand upright, 1 dust.
  Fuzz(float roughness, vec3 wo) {
    const float x = std::clamp(wo.z, 0.0f, 1.0f), y = std::clamp(roughness, 0.01f, 1.0f);
    const float length = std::sqrt(sqr(wo.x) + sqr(wo.y));
    axis_ = length > 0 ? vec2(wo.x, wo.y) / length : vec2(1, 0);
    a_ = (2.58126f * x + 0.813703f * y) * y / (1 + 0.310327f * x * x + 2.60994f * x * y);
    b_ = std::sqrt(1 - x) * (y - 1) * y * y * y /
         (0.0000254053f + 1.71228f * x - 1.71506f * x * y + 1.34174f * y * y);
    const float width = y * (0.0206607f + 1.58491f * y) / (0.0379424f + y * (1.32227f + y));
    const float middle =
        y * (-0.193854f + y * (-1.14885f + y * (1.7932f - 0.95943f * y * y))) / (0.046391f + y);
    const float offset =
        y * (0.000654023f + (-0.0207818f + 0.119681f * y) * y) / (1.26264f + y * (-1.92021f + y));
    const float gauss = std::exp(-0.5f * sqr((x - middle) / width)) / (width * std::sqrt(2 * kPi));
    albedo_ = std::clamp(gauss + offset, 0.0f, 1.0f);
  }

  /// Share of the light from wo that it scatters back.
  float albedo() const { return albedo_; }

  /// In 1/sr; integrates to 1.
  float pdf(vec3 wi) const {
    const float along = wi.x * axis_.x + wi.y * axis_.y, aside = wi.y * axis_.x - wi.x * axis_.y;
    const vec3 cosine(a_ * along + b_ * wi.z, a_ * aside, wi.z);
    return kInvPi * sqr(a_) * wi.z / sqr(length_squared(cosine));
  }
  vec3 sample(vec2 disc) const {
    const vec3 cosine = cosine_hemisphere_from_disc(disc);
    const float along = (cosine.x - b_ * cosine.z) / a_, aside = cosine.y / a_;
    return glm::normalize(
        vec3(along * axis_.x - aside * axis_.y, along * axis_.y + aside * axis_.x, cosine.z));
  }

private:
  vec2 axis_;   ///< of wo in the surface
  float a_, b_; ///< of the inverse transform (a 0 b; 0 a 0; 0 0 1)
  float albedo_;
};

} // namespace candela
