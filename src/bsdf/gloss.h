#pragma once
// What choosing a light wants to know of a BSDF: roughly how much it reflects from where.

#include "bsdf/bsdf.h"
#include "core/color.h"

namespace candela {

/// f |cos theta_i| (1/sr, in luminance) as about
///     diffuse cos theta_i + peak / (1 + sharpness (1 - cos delta))^2,
/// with delta between wi and the mirror image of wo.
struct Gloss {
  float diffuse = 1;
  float peak = 0;
  float sharpness = 0;

  /// Of the lobe, integrated over all directions.
  float lobe_albedo() const { return 2 * kPi * peak / (1 + sharpness); }
};

namespace detail {

struct GlossVisitor {
  vec3 wo;

  Gloss operator()(const Phong& b) const { // cos^n is about (1 + n / 2 (1 - cos))^-2 near the axis
    return {luminance(b.diffuse) * kInvPi, luminance(b.specular) * (b.exponent + 2) * (0.5f * kInvPi),
            0.5f * b.exponent};
  }
  /// With the half vector at delta / 2, as it is in the plane of wo and the normal. A little of the peak is
  /// given to all directions, lest one is left out where the shape is otherwise.
  Gloss operator()(const Ggx& b) const {
    const float a = b.alpha(), reflectance = luminance(b.specular);
    const float peak =
        reflectance * Ggx::distribution({0, 0, 1}, a) / (4 * std::max(Ggx::projected_area(wo, a), a));
    return {0.02f * reflectance * kInvPi, peak, 0.5f / sqr(a)};
  }
  Gloss operator()(const auto&) const { return {}; } // of delta lobes no light sample knows
};

} // namespace detail

/// wo: local, unit.
inline Gloss gloss_of(const Bsdf& bsdf, vec3 wo) { return std::visit(detail::GlossVisitor{wo}, bsdf); }

} // namespace candela
