#pragma once

#include "core/color.h"
#include "lights/light_bounds.h"
#include "lights/light_sample.h"
#include "lights/sky_model.h"

namespace candela {

/// The disc of the sun around the scene.
struct SunLight {
  SunDisc disc; ///< in the world

  static constexpr std::string_view kName = "sun";
  static constexpr LightKind kind = LightKind::infinite;

  Spectrum radiance_from(vec3 direction) const { return disc.radiance(direction); }
  std::optional<LightSample> sample(const LightSamplingContext&, vec2 u) const {
    const SunDisc::Sample found = disc.sample(u);
    LightSample s;
    s.direction = found.direction;
    s.radiance = found.radiance;
    s.pdf = found.pdf;
    s.infinite = true;
    return s;
  }
  float pdf(const LightSamplingContext&, vec3, vec3 direction) const { return disc.pdf(direction); }
  float power(float scene_radius) const { return luminance(disc.irradiance) * (kPi * sqr(scene_radius)); }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  /// A plane that faces it receives the whole, an average one a quarter.
  double mean_irradiance(EnvironmentDensity) const {
    return 0.25 * static_cast<double>(luminance(disc.irradiance));
  }
};

} // namespace candela
