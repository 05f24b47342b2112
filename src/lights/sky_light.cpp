#include "lights/sky_light.h"

#include "lights/sun_position.h"

#include <numbers>

namespace candela {

SkyParameters sky_parameters(const SkyLightModel& light) {
  SkyParameters p;
  p.sun_elevation = light.sun_elevation, p.sun_azimuth = light.sun_azimuth;
  p.turbidity = light.turbidity, p.ground_albedo = light.ground_albedo, p.ozone = light.ozone;
  p.width = light.resolution;
  if (light.sun_by == SunPlacement::place) {
    constexpr double kDegree = std::numbers::pi / 180;
    const SunPosition sun = sun_position(
        {light.year, light.month, light.day, static_cast<double>(light.hour)},
        {static_cast<double>(light.latitude) / kDegree, static_cast<double>(light.longitude) / kDegree});
    // Refraction is known as far down as that, where the sun has set.
    const bool near_horizon = sun.elevation > -kDegree;
    p.sun_elevation =
        static_cast<float>(sun.elevation + (near_horizon ? atmospheric_refraction(sun.elevation) : 0));
    p.sun_azimuth = static_cast<float>(sun.azimuth);
    p.sun_distance = static_cast<float>(sun.distance);
  }
  return p;
}

std::vector<std::variant<EnvironmentLight, SunLight>> light_of(const SkyLightModel& m, Spectrum color,
                                                               const LightResources& resources) {
  const SkyModel* sky = resources.sky(sky_parameters(m));
  EnvironmentLightModel panorama;
  panorama.rotation = m.rotation, panorama.up = m.up, panorama.panorama = sky->sky;
  const mat3 world_from_sky = world_from_panorama(panorama);
  std::vector<std::variant<EnvironmentLight, SunLight>> lights{
      EnvironmentLight{resources.environment_map(panorama), world_from_sky, color}};
  SunDisc disc = sky->sun;
  disc.direction = glm::normalize(world_from_sky * disc.direction);
  disc.irradiance *= color * m.sun_scale;
  if (!is_black(disc.irradiance)) lights.emplace_back(SunLight{disc});
  return lights;
}

} // namespace candela
