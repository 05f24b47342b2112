#pragma once

#include "core/color.h"
#include "lights/attenuation.h"
#include "lights/goniometric_light.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"

namespace candela {

/// A point that emits equally in all directions, or as a photometric file or a goniometric picture says.
struct PointLightModel {
  vec3 position{0};
  /// Coefficients a, b, c: at the distance r the irradiance on a facing surface is intensity / (a + b r + c
  /// r^2). Anything but (0, 0, 1) is not physical.
  vec3 attenuation{0, 0, 1};
  // With a file alone; lights/goniometric_light.h has the axes.
  vec3 direction{0, -1, 0}; ///< where the luminaire's nadir points, any length
  float roll = 0;           ///< radians, about its upward axis
  ProfileStrength strength = ProfileStrength::file;
  std::shared_ptr<const IesProfile> profile = nullptr;     ///< at most one of these two
  std::shared_ptr<const Panorama> panorama = nullptr;      ///< latitude and longitude
  bool operator==(const PointLightModel&) const = default; ///< files by identity

  static constexpr std::string_view kName = "point";
  static constexpr std::string_view kHelp =
      "from a point, equally in all directions or as a photometric file or picture says";
  static constexpr FieldInfo kColor = color_row("W/sr", "Radiant intensity");
  static constexpr auto rows() {
    using Row = LightRow<PointLightModel>;
    return std::array{
        Row{position_row(), &PointLightModel::position},
        Row{direction_row("With a file: where the nadir of the luminaire points"),
            &PointLightModel::direction},
        Row{roll_row("With a file: turns it about the axis through its nadir"), &PointLightModel::roll},
        Row{profile_strength_row(), &PointLightModel::strength},
        Row{attenuation_row(), &PointLightModel::attenuation},
    };
  }
  std::string problem() const {
    if (is_zero(direction)) return "direction: has no length; give a direction";
    return is_zero(attenuation) ? "attenuation: is zero; give 0 0 1 for 1 / r^2" : "";
  }
};

struct PointLight {
  vec3 position{0};
  Spectrum intensity{0}; ///< W/sr
  vec3 attenuation{0, 0, 1};

  static constexpr std::string_view kName = "point";
  static constexpr LightKind kind = LightKind::delta_position;

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2) const {
    return Attenuation{attenuation}.sample(ctx, position, intensity);
  }
  float pdf(const LightSamplingContext&, vec3, vec3) const { return 0; }
  float power(float scene_radius) const {
    return 4 * kPi * luminance(intensity) * Attenuation{attenuation}.relative_to_inverse_square(scene_radius);
  }
  std::optional<LightBounds> bounds() const {
    if (!Attenuation{attenuation}.inverse_square()) return std::nullopt;
    return omnidirectional_bounds(position, 0, static_cast<double>(luminance(intensity) / attenuation.z));
  }
  double typical_irradiance() const { return static_cast<double>(luminance(intensity)); }
};

inline std::variant<PointLight, GoniometricLight> light_of(const PointLightModel& m, Spectrum color,
                                                           const LightResources& resources) {
  if (!m.profile && !m.panorama) return PointLight{m.position, color, m.attenuation};
  return goniometric_light({m.position, m.direction, m.roll, m.profile.get(), m.panorama, m.strength, color,
                            m.attenuation, SpotCone{kPi, kPi}},
                           resources);
}

} // namespace candela
