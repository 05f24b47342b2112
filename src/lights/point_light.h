#pragma once

#include "core/color.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"
#include "lights/light_sample.h"

namespace candela {

/// A point that emits equally in all directions.
struct PointLightModel {
  vec3 position{0};
  /// Coefficients a, b, c: at the distance r the irradiance on a facing surface is intensity / (a + b r + c
  /// r^2). Anything but (0, 0, 1) is not physical.
  vec3 attenuation{0, 0, 1};
  bool operator==(const PointLightModel&) const = default;

  static constexpr std::string_view kName = "point";
  static constexpr std::string_view kHelp = "from a point, equally in all directions";
  static constexpr FieldInfo kColor = color_row("W/sr", "Radiant intensity");
  static constexpr auto rows() {
    using Row = LightRow<PointLightModel>;
    return std::array{Row{position_row(), &PointLightModel::position},
                      Row{attenuation_row(), &PointLightModel::attenuation}};
  }
  std::string problem() const {
    return is_zero(attenuation) ? "attenuation: is zero; give 0 0 1 for 1 / r^2" : "";
  }
};

/// How the light of a point falls off with the distance: LightDesc::attenuation.
struct Attenuation {
  /// Divides by x + y r + z r^2 of the distance r.
  vec3 coefficients{0, 0, 1};

  bool inverse_square() const { return coefficients.x == 0 && coefficients.y == 0; }
  template <class T>
  T divisor(T r) const {
    T a(coefficients.x), b(coefficients.y), c(coefficients.z);
    return a + b * r + c * (r * r);
  }
  /// How many times stronger a light is at the distance r than one that falls with the square is.
  float relative_to_inverse_square(float r) const {
    auto d = static_cast<double>(r);
    return static_cast<float>(d * d / divisor(d));
  }
  /// Of a light at `position` whose intensity towards the shading point is `intensity`.
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec3 position,
                                    Spectrum intensity) const {
    float distance2 = length_squared(position - ctx.position);
    if (!(distance2 > 0)) return std::nullopt;
    float by = coefficients.z * distance2;
    if (!inverse_square()) by = divisor(std::sqrt(distance2));
    std::optional<LightSample> s;
    set_towards(s.emplace(), ctx, position, vec3(0), vec3(0), intensity / by, 1);
    s->delta = true;
    return s;
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

inline PointLight light_of(const PointLightModel& m, Spectrum color, const EnvironmentMapSource&) {
  return {m.position, color, m.attenuation};
}

} // namespace candela
