#pragma once

#include "core/color.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"
#include "lights/light_sample.h"
#include "lights/portal_guide.h"
#include "sampling/warp.h"

namespace candela {

/// The same radiance from every direction.
struct ConstantLightModel {
  bool operator==(const ConstantLightModel&) const = default;

  static constexpr std::string_view kName = "constant";
  static constexpr std::string_view kHelp = "the same from every direction";
  static constexpr FieldInfo kColor = color_row("W/(m^2 sr)", "Radiance");
  static constexpr std::array<LightRow<ConstantLightModel>, 0> rows() { return {}; }
  std::string problem() const { return ""; }
};

/// The same radiance from everywhere: sampled by the cosine on the normal's side, or on both where the point
/// transmits; evenly from all around for a point in a medium.
struct ConstantLight {
  Spectrum radiance{0};
  const PortalGuide* portals = nullptr; ///< through which it comes, if the scene has any. Somebody else's

  static constexpr std::string_view kName = "constant";
  static constexpr LightKind kind = LightKind::infinite;

  Spectrum radiance_from(vec3) const { return radiance; }
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (portals == nullptr) return sample_by_cosine(ctx, u);
    return portals->mixed_sample(
        ctx, u, [&](vec2 rest) { return sample_by_cosine(ctx, rest); },
        [&](vec3 direction) {
          return RadiancePdf{radiance, cosine_pdf(ctx, direction)};
        });
  }
  float pdf(const LightSamplingContext& ctx, vec3, vec3 direction) const {
    const float own = cosine_pdf(ctx, direction);
    return portals == nullptr ? own : portals->mixed_pdf(portals->seen_from(ctx), direction, own);
  }
  float power(float scene_radius) const { return luminance(radiance) * 4 * kPi * (kPi * sqr(scene_radius)); }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double mean_irradiance(EnvironmentDensity) const { return static_cast<double>(kPi * luminance(radiance)); }

private:
  std::optional<LightSample> sample_by_cosine(const LightSamplingContext& ctx, vec2 u) const {
    LightSample s;
    if (ctx.domain == ScatteringDomain::volume) {
      s.direction = sample_uniform_sphere(u);
    } else {
      const bool transmits = ctx.domain == ScatteringDomain::sphere;
      const bool behind = transmits && u.x < 0.5f;
      if (transmits) u.x = std::min(behind ? 2 * u.x : 2 * u.x - 1, kOneMinusEpsilon);
      vec3 local = sample_cosine_hemisphere(u);
      if (!(local.z > 0)) return std::nullopt;
      if (behind) local.z = -local.z;
      s.direction = Basis::from_normal(ctx.normal).to_world(local);
    }
    s.radiance = radiance;
    s.pdf = cosine_pdf(ctx, s.direction);
    s.infinite = true;
    if (!(s.pdf > 0)) return std::nullopt; // the frame rounds
    return s;
  }
  float cosine_pdf(const LightSamplingContext& ctx, vec3 direction) const {
    if (ctx.domain == ScatteringDomain::volume) return kUniformSpherePdf;
    const float cosine = glm::dot(ctx.normal, direction);
    return ctx.domain == ScatteringDomain::sphere ? 0.5f * cosine_hemisphere_pdf(std::abs(cosine))
                                                  : cosine_hemisphere_pdf(cosine);
  }
};

inline ConstantLight light_of(const ConstantLightModel&, Spectrum color, const LightResources&) {
  return {color};
}

} // namespace candela
