#pragma once

#include "core/color.h"
#include "lights/attenuation.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"
#include "lights/panorama.h"

#include <memory>

namespace candela {

/// A point that throws a picture, as a slide projector does.
struct ProjectorLightModel {
  vec3 position{0};
  vec3 direction{0, 0, -1}; ///< to the middle of the picture, any length
  float roll = 0;           ///< radians, clockwise on a screen as seen from the light
  float vertical_fov = radians(30.0f);
  vec3 attenuation{0, 0, 1};                                   ///< as PointLightModel has it
  std::shared_ptr<const Panorama> panorama = nullptr;          ///< the picture; null: a white square
  bool operator==(const ProjectorLightModel&) const = default; ///< the picture by identity

  static constexpr std::string_view kName = "projector";
  static constexpr std::string_view kHelp = "from a point, a picture";
  static constexpr FieldInfo kColor =
      color_row("W/sr", "Multiplies the picture: the radiant intensity on the axis where that is white");
  static constexpr auto rows() {
    using Row = LightRow<ProjectorLightModel>;
    return std::array{
        Row{position_row(), &ProjectorLightModel::position},
        Row{direction_row("To the middle of the picture"), &ProjectorLightModel::direction},
        Row{roll_row("Turns the picture clockwise, as seen from the light; at 0 it is upright, and thrown "
                     "straight "
                     "up or down its top lies towards -z"),
            &ProjectorLightModel::roll},
        Row{{"vertical_fov", FieldType::angle, 0.01, 175, "degrees",
             "Angle that the picture's height takes; its width follows from the picture", Invalidates::scene},
            &ProjectorLightModel::vertical_fov},
        Row{attenuation_row(), &ProjectorLightModel::attenuation},
    };
  }
  std::string problem() const {
    if (is_zero(direction)) return "direction: has no length; give a direction";
    return is_zero(attenuation) ? "attenuation: is zero; give 0 0 1 for 1 / r^2" : "";
  }
};

/// The picture lies in the plane at the distance 1, where texels are bilinear between their centres. A screen
/// there is lit evenly by an even picture, as by Mitsuba's projector: the intensity grows with 1 / cos^3 of
/// the angle to the axis.
struct ProjectorLight {
  vec3 position{0};
  vec3 right{1, 0, 0}, up{0, 1, 0}; ///< of the picture; unit. It is thrown along cross(up, right)
  vec2 half_size{1};                ///< of the picture at the distance 1
  const Image* picture = nullptr;   ///< somebody else's; null: white
  Spectrum intensity{0};            ///< W/sr on the axis, of white
  vec3 attenuation{0, 0, 1};
  float mean = 1, maximum = 1; ///< luminance of the picture

  static constexpr std::string_view kName = "projector";
  static constexpr LightKind kind = LightKind::delta_position;

  vec3 axis() const { return glm::cross(up, right); }
  /// W/sr in a direction away from the light, of any length.
  Spectrum intensity_towards(vec3 direction) const;
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2) const;
  float pdf(const LightSamplingContext&, vec3, vec3) const { return 0; }
  /// Of an intensity I / cos^3 that of the plane at the distance 1: irradiance times area.
  float power(float scene_radius) const;
  std::optional<LightBounds> bounds() const;
  double typical_irradiance() const { return static_cast<double>(luminance(intensity) * maximum); }

private:
  Spectrum texel_at(vec2 place) const;
};

ProjectorLight light_of(const ProjectorLightModel& m, Spectrum color, const LightResources&);

} // namespace candela
