#pragma once

#include "core/color.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"
#include "lights/light_sample.h"

namespace candela {

/// Parallel light from a distant source.
struct DirectionalLightModel {
  vec3 direction{0, -1, 0}; ///< along which the light travels, any length
  bool operator==(const DirectionalLightModel&) const = default;

  static constexpr std::string_view kName = "directional";
  static constexpr std::string_view kHelp = "parallel, from a distant source";
  static constexpr FieldInfo kColor = color_row("W/m^2", "Irradiance of a surface that faces the light");
  static constexpr auto rows() {
    return std::array{LightRow<DirectionalLightModel>{
        direction_row("The direction in which the light travels"), &DirectionalLightModel::direction}};
  }
  std::string problem() const {
    return is_zero(direction) ? "direction: has no length; give a direction" : "";
  }
};

struct DirectionalLight {
  vec3 direction{0, -1, 0}; ///< unit, along which it travels
  Spectrum irradiance{0};   ///< W/m^2 on a plane that faces it

  static constexpr std::string_view kName = "directional";
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

inline DirectionalLight light_of(const DirectionalLightModel& m, Spectrum color, const LightResources&) {
  return {glm::normalize(m.direction), color};
}

} // namespace candela
