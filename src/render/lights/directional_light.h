#pragma once

#include "core/color.h"
#include "render/lights/light_bounds.h"
#include "render/lights/light_sample.h"

namespace candela {

struct DirectionalLight {
  vec3 direction{0, -1, 0}; ///< unit, along which it travels
  Spectrum irradiance{0};   ///< W/m^2 on a plane that faces it

  static constexpr LightKind kind = LightKind::delta_direction;

  std::optional<LightSample> sample(const LightSamplingContext&, vec2) const {
    LightSample s;
    s.direction = -direction;
    s.radiance = irradiance;
    s.pdf = 1;
    s.delta = s.infinite = true;
    return s;
  }
  float pdf(const LightSamplingContext&, vec3, vec3) const { return 0; }
  float power(float scene_radius) const { return luminance(irradiance) * (kPi * sqr(scene_radius)); }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double typical_irradiance() const { return static_cast<double>(luminance(irradiance)); }
};

} // namespace candela
