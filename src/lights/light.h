#pragma once
// The list of lights. Shapes shine by their material; the others come from LightDesc (lights/light_desc.h).

#include "core/variant.h"
#include "lights/constant_light.h"
#include "lights/curve_light.h"
#include "lights/directional_light.h"
#include "lights/disc_light.h"
#include "lights/environment_light.h"
#include "lights/goniometric_light.h"
#include "lights/point_light.h"
#include "lights/portal_light.h"
#include "lights/projector_light.h"
#include "lights/rectangle_light.h"
#include "lights/sky_light.h"
#include "lights/sphere_light.h"
#include "lights/spot_light.h"
#include "lights/sun_light.h"
#include "lights/triangle_light.h"

namespace candela {

/// What every light offers.
/// - kName: name for users.
/// - kind: how it is sampled.
/// - sample: a direction towards the light; nothing if the light is not visible from the point, or has no
///   direction in its domain. `u` in [0, 1)^2.
/// - pdf: density in 1/sr of sample() for the direction towards `point` (area lights) or for `direction`
///   (infinite lights); 0 for directions that it never gives, and for delta lights.
/// - power: emitted power in W, for light selection; for infinite lights and for unphysical attenuations, the
///   power that reaches a scene of the given radius.
/// - bounds: position and orientation; nothing for lights without a place, and for those that do not fall off
///   with the square of the distance ("unbounded").
///
/// Infinite lights have radiance_from(direction): W/(m^2 sr) from a unit direction away from the scene.
/// Lights that may be unbounded state their strength as luminance:
/// - mean_irradiance(density): W/m^2 on an average plane, if it is the same for all points;
/// - typical_irradiance(): otherwise, a representative value.
template <class L>
concept LightModel = requires(const L& light, const LightSamplingContext& ctx, vec2 u, vec3 v, float radius) {
  { L::kName } -> std::convertible_to<std::string_view>;
  { L::kind } -> std::convertible_to<LightKind>;
  { light.sample(ctx, u) } -> std::same_as<std::optional<LightSample>>;
  { light.pdf(ctx, v, v) } -> std::same_as<float>;
  { light.power(radius) } -> std::same_as<float>;
  { light.bounds() } -> std::same_as<std::optional<LightBounds>>;
}
&&(L::kind != LightKind::infinite || requires(const L& light, vec3 direction) {
  { light.radiance_from(direction) } -> std::same_as<Spectrum>;
});

/// What scenes say of lights without a shape, see lights/light_rows.h. A new light is a file of its own, and
/// its names here and below.
using LightDescModel =
    std::variant<PointLightModel, DirectionalLightModel, ConstantLightModel, SpotLightModel,
                 EnvironmentLightModel, ProjectorLightModel, SkyLightModel, PortalLightModel>;

/// All lights as transport samples them, those that shapes are among them.
using Light = std::variant<RectangleLight, TriangleLight, SphereLight, DiscLight, PointLight,
                           DirectionalLight, ConstantLight, SpotLight, EnvironmentLight, GoniometricLight,
                           ProjectorLight, SunLight, CurveLight>;

namespace detail {

template <class... Models>
constexpr bool are_light_models(const std::variant<Models...>*) {
  return (LightModel<Models> && ...);
}
static_assert(are_light_models(static_cast<const Light*>(nullptr)));

} // namespace detail

// As LightModel's members of the same names.

inline std::string_view light_name(const Light& light) {
  return visit_variant([](const auto& l) { return l.kName; }, light);
}
inline LightKind light_kind(const Light& light) {
  return visit_variant([](const auto& l) { return l.kind; }, light);
}
inline std::optional<LightSample> sample_light(const Light& light, const LightSamplingContext& ctx, vec2 u) {
  return visit_variant([&](const auto& l) { return l.sample(ctx, u); }, light);
}
inline float light_pdf(const Light& light, const LightSamplingContext& ctx, vec3 point, vec3 direction) {
  return visit_variant([&](const auto& l) { return l.pdf(ctx, point, direction); }, light);
}
inline float light_power(const Light& light, float scene_radius) {
  return visit_variant([&](const auto& l) { return l.power(scene_radius); }, light);
}
inline std::optional<LightBounds> light_bounds(const Light& light) {
  return visit_variant([](const auto& l) { return l.bounds(); }, light);
}

/// Whether light sampling alone can find it.
inline bool is_delta_light(const Light& light) {
  const LightKind kind = light_kind(light);
  return kind == LightKind::delta_position || kind == LightKind::delta_direction;
}
/// What an infinite light sends to the scene from `direction` (unit, away from the scene), W/(m^2 sr); 0 for
/// all others.
inline Spectrum light_radiance(const Light& light, vec3 direction) {
  return visit_variant(
      [&](const auto& l) {
        if constexpr (requires { l.radiance_from(direction); })
          return l.radiance_from(direction);
        else
          return Spectrum(0);
      },
      light);
}
/// 0 for lights whose irradiance differs from point to point.
inline double light_mean_irradiance(const Light& light, EnvironmentDensity density) {
  return visit_variant(
      [&](const auto& l) {
        if constexpr (requires { l.mean_irradiance(density); })
          return l.mean_irradiance(density);
        else
          return 0.0;
      },
      light);
}
/// Of an unbounded light.
inline double light_typical_irradiance(const Light& light) {
  return visit_variant(
      [&](const auto& l) {
        if constexpr (requires { l.typical_irradiance(); })
          return l.typical_irradiance();
        else if constexpr (requires { l.mean_irradiance(EnvironmentDensity::full); })
          return l.mean_irradiance(EnvironmentDensity::full);
        else
          return 0.0;
      },
      light);
}

} // namespace candela
