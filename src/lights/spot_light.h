#pragma once

#include "lights/light_rows.h"
#include "lights/point_light.h"

namespace candela {

/// A point that emits into a cone, within it perhaps as a photometric file says.
struct SpotLightModel {
  vec3 position{0};
  vec3 direction{0, -1, 0}; ///< the axis, any length
  /// Half the opening angle, radians: no light beyond it. Full intensity within beam_width of the axis,
  /// falling linearly with the angle between the two, as in Mitsuba; a wider beam is cut off sharply.
  float cutoff_angle = radians(20.0f);
  float beam_width = radians(15.0f);
  vec3 attenuation{0, 0, 1}; ///< as PointLightModel has it
  // As PointLightModel has them; `direction` is where the luminaire's nadir points.
  float roll = 0;
  ProfileStrength strength = ProfileStrength::file;
  std::shared_ptr<const IesProfile> profile = nullptr;
  bool operator==(const SpotLightModel&) const = default; ///< the file by identity

  static constexpr std::string_view kName = "spot";
  static constexpr std::string_view kHelp =
      "from a point, into a cone, as a photometric file says if there is one";
  static constexpr FieldInfo kColor = color_row("W/sr", "Radiant intensity on the axis");
  static constexpr auto rows() {
    using Row = LightRow<SpotLightModel>;
    return std::array{
        Row{position_row(), &SpotLightModel::position},
        Row{direction_row("The axis: the light travels along it"), &SpotLightModel::direction},
        Row{{"cutoff_angle", FieldType::angle, 0.01, 180, "degrees",
             "Angle from the axis beyond which there is no light", Invalidates::scene},
            &SpotLightModel::cutoff_angle},
        Row{{"beam_width", FieldType::angle, 0, 180, "degrees",
             "Angle from the axis up to which the intensity is full; from there it falls to the cutoff",
             Invalidates::scene},
            &SpotLightModel::beam_width},
        Row{roll_row("With a file: turns it about the axis"), &SpotLightModel::roll},
        Row{profile_strength_row(), &SpotLightModel::strength},
        Row{attenuation_row(), &SpotLightModel::attenuation},
    };
  }
  std::string problem() const {
    if (is_zero(direction)) return "direction: has no length; give a direction";
    return is_zero(attenuation) ? "attenuation: is zero; give 0 0 1 for 1 / r^2" : "";
  }
};

struct SpotLight {
  vec3 position{0};
  vec3 axis{0, -1, 0};                    ///< unit
  float beam_width = 0, cutoff_angle = 0; ///< radians from the axis, beam_width <= cutoff_angle
  Spectrum intensity{0};                  ///< W/sr within the beam
  vec3 attenuation{0, 0, 1};

  static constexpr std::string_view kName = "spot";
  static constexpr LightKind kind = LightKind::delta_position;

  float falloff(float angle) const { return SpotCone{beam_width, cutoff_angle}.falloff(angle); }
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2) const {
    vec3 d = ctx.position - position;
    float share = falloff(std::atan2(glm::length(glm::cross(axis, d)), glm::dot(axis, d)));
    if (share == 0) return std::nullopt;
    return Attenuation{attenuation}.sample(ctx, position, share * intensity);
  }
  float pdf(const LightSamplingContext&, vec3, vec3) const { return 0; }
  float power(float scene_radius) const { // the integral of falloff over the sphere
    float ramp = cutoff_angle - beam_width;
    float mean_cosine =
        ramp > 1e-4f ? (std::sin(cutoff_angle) - std::sin(beam_width)) / ramp : std::cos(cutoff_angle);
    return 2 * kPi * (1 - mean_cosine) * luminance(intensity) *
           Attenuation{attenuation}.relative_to_inverse_square(scene_radius);
  }
  std::optional<LightBounds> bounds() const {
    if (!Attenuation{attenuation}.inverse_square()) return std::nullopt;
    auto b = omnidirectional_bounds(position, 0, static_cast<double>(luminance(intensity) / attenuation.z));
    b.axis = axis;
    b.theta_o = std::max(beam_width, cutoff_angle - 0.5f * kPi);
    b.theta_e = std::min(cutoff_angle - b.theta_o, 0.5f * kPi);
    b.theta_o = std::min(b.theta_o + kBoundsConeSlack, kPi);
    return b;
  }
  double typical_irradiance() const { return static_cast<double>(luminance(intensity)); }
};

inline std::variant<SpotLight, GoniometricLight> light_of(const SpotLightModel& m, Spectrum color,
                                                          const LightResources& resources) {
  const SpotCone cone{std::min(m.beam_width, m.cutoff_angle), m.cutoff_angle};
  if (!m.profile)
    return SpotLight{m.position,   glm::normalize(m.direction), cone.beam_width, cone.cutoff_angle, color,
                     m.attenuation};
  return goniometric_light(
      {m.position, m.direction, m.roll, m.profile.get(), nullptr, m.strength, color, m.attenuation, cone},
      resources);
}

} // namespace candela
