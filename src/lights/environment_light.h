#pragma once

#include "core/color.h"
#include "lights/constant_light.h"
#include "lights/environment_map.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"
#include "lights/light_sample.h"
#include "lights/panorama.h"
#include "lights/portal_guide.h"

#include <memory>

namespace candela {

/// The radiance of a panorama around the scene.
struct EnvironmentLightModel {
  EnvironmentMapping mapping = EnvironmentMapping::latlong;
  float rotation = 0; ///< radians, turns the panorama about `up`, counter-clockwise seen from its tip
  vec3 up{0, 1, 0};   ///< what the panorama's up (its +y) is in the world; any length
  std::shared_ptr<const Panorama> panorama = nullptr;            ///< null: constant radiance
  bool operator==(const EnvironmentLightModel&) const = default; ///< the panorama by identity

  static constexpr std::string_view kName = "environment";
  static constexpr std::string_view kHelp = "a panorama around the scene";
  static constexpr FieldInfo kColor =
      color_row("", "Multiplies the panorama's radiance; without a panorama, the radiance in W/(m^2 sr)");
  static constexpr std::array<std::string_view, 4> kMappings = {"latlong", "angular", "cross", "faces"};
  static constexpr auto rows() {
    using Row = LightRow<EnvironmentLightModel>;
    return std::array{
        Row{{"mapping", FieldType::choice, 0, 0, "",
             "How directions map to the panorama: latitude and longitude, Debevec's angular map, an unfolded "
             "cube, or its six faces",
             Invalidates::scene, kMappings},
            &EnvironmentLightModel::mapping},
        Row{{"rotation", FieldType::angle, -360, 360, "degrees",
             "Turns the panorama about its up axis, counter-clockwise seen from above", Invalidates::scene},
            &EnvironmentLightModel::rotation},
        Row{{"up", FieldType::point, -kAnyCoordinate, kAnyCoordinate, "",
             "The direction that is up in the panorama", Invalidates::scene},
            &EnvironmentLightModel::up},
    };
  }
  std::string problem() const { return is_zero(up) ? "up: has no length; give a direction" : ""; }
};

/// A panorama, sampled in proportion to its radiance.
struct EnvironmentLight {
  const EnvironmentMap* map = nullptr;
  mat3 world_from_map{1.0f}; ///< a rotation
  Spectrum factor{1};
  const PortalGuide* portals = nullptr; ///< through which it comes, if the scene has any. Somebody else's

  static constexpr std::string_view kName = "environment";
  static constexpr LightKind kind = LightKind::infinite;

  Spectrum radiance_from(vec3 direction) const { return factor * map->radiance(direction * world_from_map); }
  /// For looking up many directions: locating them all first prefetches their texels. That halves the time
  /// for a panorama of 2048 x 1024.
  EnvironmentMap::Place locate(vec3 direction) const { return map->locate(direction * world_from_map); }
  /// radiance_from() and pdf() at once.
  RadiancePdf radiance_pdf(const LightSamplingContext& ctx, const EnvironmentMap::Place& at) const {
    const auto found = map->lookup(at, ctx.environment_density());
    if (portals == nullptr) return {factor * found.radiance, found.pdf};
    return {factor * found.radiance,
            portals->mixed_pdf(portals->seen_from(ctx), world_from_map * at.direction, found.pdf)};
  }
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (portals == nullptr) return sample_map(ctx, u);
    return portals->mixed_sample(
        ctx, u, [&](vec2 rest) { return sample_map(ctx, rest); },
        [&](vec3 direction) {
          const auto found = map->lookup(direction * world_from_map, ctx.environment_density());
          return RadiancePdf{factor * found.radiance, found.pdf};
        });
  }
  float pdf(const LightSamplingContext& ctx, vec3, vec3 direction) const {
    const float own = map_pdf(ctx, direction);
    return portals == nullptr ? own : portals->mixed_pdf(portals->seen_from(ctx), direction, own);
  }
  float power(float scene_radius) const {
    return luminance(factor) * map->total_luminance() * (kPi * sqr(scene_radius));
  }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double mean_irradiance(EnvironmentDensity density) const {
    return 0.25 * static_cast<double>(luminance(factor) * map->total_luminance(density));
  }

private:
  std::optional<LightSample> sample_map(const LightSamplingContext& ctx, vec2 u) const {
    auto found = map->sample(u, ctx.environment_density());
    if (!found) return std::nullopt;
    LightSample s;
    s.direction = world_from_map * found->direction;
    s.radiance = factor * found->radiance;
    s.pdf = found->pdf;
    s.infinite = true;
    return s;
  }
  float map_pdf(const LightSamplingContext& ctx, vec3 direction) const {
    return map->pdf(direction * world_from_map, ctx.environment_density());
  }
};

/// First `rotation` (radians) about +y, then the smallest turn that takes +y to `up_direction`, of any
/// length.
inline mat3 turned_about_up(vec3 up_direction, float rotation) {
  glm::dvec3 up = glm::normalize(glm::dvec3(up_direction)), y(0, 1, 0), axis = glm::cross(y, up);
  double sine = glm::length(axis), tilt = std::atan2(sine, up.y);
  axis = sine > 0 ? axis / sine : glm::dvec3(1, 0, 0);
  glm::dmat4 turn = glm::rotate(glm::dmat4(1), tilt, axis);
  return mat3(glm::rotate(turn, static_cast<double>(rotation), y));
}
inline mat3 world_from_panorama(const EnvironmentLightModel& light) {
  return turned_about_up(light.up, light.rotation);
}

/// A constant light where there is no panorama.
inline std::variant<ConstantLight, EnvironmentLight> light_of(const EnvironmentLightModel& m, Spectrum color,
                                                              const LightResources& resources) {
  if (m.panorama) return EnvironmentLight{resources.environment_map(m), world_from_panorama(m), color};
  return ConstantLight{color};
}

} // namespace candela
