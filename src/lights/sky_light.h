#pragma once

#include "lights/environment_light.h"
#include "lights/sky_model.h"
#include "lights/sun_light.h"

namespace candela {

/// The sun and a clear sky around the scene (lights/sky_model.h).
struct SkyLightModel {
  SunPlacement sun_by = SunPlacement::angles;
  float sun_elevation = radians(45.0f),
        sun_azimuth = radians(135.0f);                         ///< of `angles`; as SkyParameters has them
  float latitude = radians(50.0f), longitude = radians(10.0f); ///< of `place`; north and east
  int year = 2025, month = 6, day = 21; ///< a day beyond the month's last is one of the next
  float hour = 14;                      ///< universal time
  float turbidity = 2, ground_albedo = 0.2f, ozone = 300; ///< as SkyParameters has them
  float sun_scale = 1;                                    ///< multiplies the sun alone
  int resolution = 512;                                   ///< columns of the sky's panorama
  float rotation = 0;                                     ///< as EnvironmentLightModel has it: turns north
  vec3 up{0, 1, 0};
  bool operator==(const SkyLightModel&) const = default;

  static constexpr std::string_view kName = "sky";
  static constexpr std::string_view kHelp = "the sun and a clear sky";
  static constexpr FieldInfo kColor = color_row("", "Multiplies the radiance of sun and sky");
  static constexpr std::array<std::string_view, 2> kPlacements = {"angles", "place"};
  static constexpr auto rows() {
    using Row = LightRow<SkyLightModel>;
    constexpr auto kScene = Invalidates::scene;
    return std::array{
        Row{{"sun_by", FieldType::choice, 0, 0, "",
             "What tells where the sun stands: its angles, or a place on earth and a time", kScene,
             kPlacements},
            &SkyLightModel::sun_by},
        Row{{"sun_elevation", FieldType::angle, -90, 90, "degrees", "By angles: the sun's, above the horizon",
             kScene},
            &SkyLightModel::sun_elevation},
        Row{{"sun_azimuth", FieldType::angle, -360, 360, "degrees",
             "By angles: the sun's, from north (-z) by east (+x)", kScene},
            &SkyLightModel::sun_azimuth},
        Row{{"latitude", FieldType::angle, -90, 90, "degrees", "By place: north is positive", kScene},
            &SkyLightModel::latitude},
        Row{{"longitude", FieldType::angle, -180, 180, "degrees", "By place: east is positive", kScene},
            &SkyLightModel::longitude},
        Row{{"year", FieldType::integer, 1950, 2050, "", "By place: of the date", kScene},
            &SkyLightModel::year},
        Row{{"month", FieldType::integer, 1, 12, "", "By place: of the date", kScene}, &SkyLightModel::month},
        Row{{"day", FieldType::integer, 1, 31, "", "By place: of the date", kScene}, &SkyLightModel::day},
        Row{{"hour", FieldType::real, 0, 24, "h", "By place: universal time, with its fraction", kScene},
            &SkyLightModel::hour},
        Row{{"turbidity", FieldType::real, 1, 20, "", "1: no haze, 2: clear, 6: hazy", kScene},
            &SkyLightModel::turbidity},
        Row{{"ground_albedo", FieldType::real, 0, 1, "",
             "Share of the light that the ground reflects to the sky", kScene},
            &SkyLightModel::ground_albedo},
        Row{{"ozone", FieldType::real, 0, 1000, "DU", "Of the air: it makes the blue of dusk", kScene},
            &SkyLightModel::ozone},
        Row{{"sun_scale",
             FieldType::real,
             0,
             1e9,
             "",
             "Multiplies the sun alone; 0 leaves the sky",
             kScene,
             {},
             true},
            &SkyLightModel::sun_scale},
        Row{{"resolution", FieldType::integer, 32, 2048, "", "Columns of the sky's panorama", kScene},
            &SkyLightModel::resolution},
        Row{{"rotation", FieldType::angle, -360, 360, "degrees",
             "Turns the sky about its up axis, counter-clockwise seen from above", kScene},
            &SkyLightModel::rotation},
        Row{{"up", FieldType::point, -kAnyCoordinate, kAnyCoordinate, "", "The direction of the zenith",
             kScene},
            &SkyLightModel::up},
    };
  }
  std::string problem() const { return is_zero(up) ? "up: has no length; give a direction" : ""; }
};

/// What the sky is made of: the sun where it is seen, refraction included.
SkyParameters sky_parameters(const SkyLightModel& light);

/// The sky as a panorama, and the sun.
std::vector<std::variant<EnvironmentLight, SunLight>> light_of(const SkyLightModel& m, Spectrum color,
                                                               const LightResources& resources);

} // namespace candela
