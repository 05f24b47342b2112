#pragma once
// Lights as the integrator samples them. Shapes shine by their material; the others come from LightDesc.

#include "bsdf/gloss.h"
#include "core/basis.h"
#include "core/ray.h"
#include "render/lights/environment_map.h"
#include "sampling/spherical_rectangle.h"
#include "sampling/warp.h"

#include <optional>
#include <span>
#include <variant>

namespace candela {

/// The point that looks for light.
struct LightReference {
  vec3 position{0};
  vec3 normal{0, 0, 1}; ///< unit geometric normal, turned to the side that reflects
  /// Light from behind is scattered, too. No BSDF that lights are aimed from does so yet.
  bool transmits = false;
  /// Directions that the BSDF scatters are tried as well and weighed against those aimed: a light may leave
  /// to them what they find well.
  bool also_by_chance = false;
  Gloss gloss{};    ///< what the point makes of the light, for choosing among several
  vec3 mirrored{0}; ///< unit, the axis of the glossy lobe

  /// Whether light sampling may aim there: what chooses lights, aims at them and weighs light that was met by
  /// chance against that must all ask this one. By the cosine with `normal`, or by a unit direction.
  bool accepts(float cosine) const { return cosine > 0 || (transmits && cosine < 0); }
  bool accepts(vec3 direction) const { return accepts(glm::dot(normal, direction)); }

  EnvironmentAim environment_aim() const {
    return also_by_chance ? EnvironmentAim::bright : EnvironmentAim::all;
  }
};

struct LightSample {
  vec3 direction{0};    ///< unit, from the reference towards the light
  vec3 point{0};        ///< on the light; unused where `infinite`
  vec3 point_error{0};  ///< absolute bound per axis
  vec3 point_normal{0}; ///< unit geometric normal there; zero for a point light
  vec3 radiance{
      0}; ///< W/(m^2 sr) arriving if nothing is between; for delta lights: irradiance on a facing plane
  float pdf = 0;      ///< 1/sr at the reference; 1 for delta lights
  bool delta = false; ///< no other strategy can find it
  bool infinite = false;
};

/// What every light offers.
/// - sample: nothing where the light cannot be seen from the reference. `u` in [0, 1)^2.
/// - pdf: density in 1/sr with which sample() gives the direction towards `point` (area lights; `normal` is
/// the
///   light's there) or towards `direction` (infinite ones); 0 where it gives none.
struct TriangleLight {
  vec3 corner{0}, edge1{0}, edge2{0}, normal{0}; ///< normal: unit
  float area = 0;
  vec3 emission{0};
  bool two_sided = false;

  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference& ref, vec3 point, vec3 direction) const;
};

/// Sampled in solid angle (Ureña et al. 2013), by area where it covers too little of the sphere for that.
struct RectangleLight {
  vec3 corner{0}, edge_x{0}, edge_y{0}, normal{0}; ///< edges perpendicular, normal: unit
  vec3 axis_x{0}, axis_y{0};                       ///< unit, along the edges
  float length_x = 0, length_y = 0;
  vec3 point_error{0}; ///< of every point on it
  vec3 emission{0};
  bool two_sided = false;

  RectangleLight() = default;
  RectangleLight(vec3 corner, vec3 edge_x, vec3 edge_y, vec3 emission, bool two_sided);
  float area() const { return length_x * length_y; }

  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference& ref, vec3 point, vec3 direction) const;
};

/// Sampled in the cone that it covers; from inside (two-sided only) by area.
struct SphereLight {
  vec3 center{0};
  float radius = 1;
  vec3 emission{0};
  bool two_sided = false;

  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference& ref, vec3 point, vec3 direction) const;
};

struct DiscLight {
  vec3 center{0}, normal{0};
  float radius = 1;
  vec3 emission{0};
  bool two_sided = false;

  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference& ref, vec3 point, vec3 direction) const;
};

struct PointLight {
  vec3 position{0};
  vec3 intensity{0};         ///< W/sr
  vec3 attenuation{0, 0, 1}; ///< of LightDesc

  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference&, vec3, vec3) const { return 0; }
};

struct SpotLight {
  vec3 position{0};
  vec3 axis{0, -1, 0};                    ///< unit
  float beam_width = 0, cutoff_angle = 0; ///< radians from the axis, beam_width <= cutoff_angle
  vec3 intensity{0};                      ///< W/sr within the beam
  vec3 attenuation{0, 0, 1};              ///< of LightDesc

  /// Share of the intensity at an angle to the axis.
  float falloff(float angle) const;
  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference&, vec3, vec3) const { return 0; }
};

struct DirectionalLight {
  vec3 direction{0, -1, 0}; ///< unit, along which it travels
  vec3 irradiance{0};       ///< W/m^2 on a plane that faces it

  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference&, vec3, vec3) const { return 0; }
};

/// The same radiance from everywhere: sampled by the cosine on the reference's side, or on both where it
/// transmits.
struct ConstantLight {
  vec3 radiance{0};

  vec3 radiance_from(vec3) const { return radiance; }
  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference& ref, vec3, vec3 direction) const {
    const float cosine = glm::dot(ref.normal, direction);
    return ref.transmits ? 0.5f * cosine_hemisphere_pdf(std::abs(cosine)) : cosine_hemisphere_pdf(cosine);
  }
};

/// A panorama, sampled in proportion to what it sends.
struct EnvironmentLight {
  const EnvironmentMap* map = nullptr;
  mat3 world_from_map{1.0f}; ///< a rotation
  vec3 factor{1};

  vec3 radiance_from(vec3 direction) const { return factor * map->radiance(direction * world_from_map); }
  std::optional<LightSample> sample(const LightReference& ref, vec2 u) const;
  float pdf(const LightReference& ref, vec3, vec3 direction) const {
    return map->pdf(direction * world_from_map, ref.environment_aim());
  }
};

using Light = std::variant<RectangleLight, TriangleLight, SphereLight, DiscLight, PointLight,
                           DirectionalLight, ConstantLight, SpotLight, EnvironmentLight>;

inline std::optional<LightSample> sample_light(const Light& light, const LightReference& ref, vec2 u) {
  return std::visit([&](const auto& l) { return l.sample(ref, u); }, light);
}
inline float light_pdf(const Light& light, const LightReference& ref, vec3 point, vec3 direction) {
  return std::visit([&](const auto& l) { return l.pdf(ref, point, direction); }, light);
}
/// What an infinite light sends to the scene from `direction` (unit, away from the scene), W/(m^2 sr); 0 for
/// lights that no ray into the distance can meet.
inline vec3 light_radiance(const Light& light, vec3 direction) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.radiance_from(direction); })
          return l.radiance_from(direction);
        else
          return vec3(0);
      },
      light);
}
inline bool is_delta_light(const Light& light) {
  return std::holds_alternative<PointLight>(light) || std::holds_alternative<SpotLight>(light) ||
         std::holds_alternative<DirectionalLight>(light);
}

/// Emitted power in W for choosing among lights; of infinite ones, and of those whose attenuation is not
/// physical, that which meets a scene of the given radius.
float light_power(const Light& light, float scene_radius);

} // namespace candela
