#pragma once
// What a light gives when it is sampled.

#include "core/ray.h"
#include "core/spectrum.h"
#include "lights/light_sampling_context.h"

#include <optional>
#include <string_view>

namespace candela {

/// How a light can be found.
enum class LightKind : std::uint8_t {
  delta_position,  ///< from one point: by light sampling alone
  delta_direction, ///< from one direction: by light sampling alone
  area,            ///< a surface, which rays can hit
  infinite,        ///< around the scene; rays that leave it find it
};

struct LightSample {
  vec3 direction{0};    ///< unit, from the shading point towards the light
  vec3 point{0};        ///< on the light; unused where `infinite`
  vec3 point_error{0};  ///< absolute bound per axis
  vec3 point_normal{0}; ///< unit geometric normal there; zero for a point light
  /// W/(m^2 sr) arriving if nothing is between; for delta lights: irradiance on a facing plane.
  Spectrum radiance{0};
  float pdf = 0;      ///< 1/sr at the shading point; 1 for delta lights
  bool delta = false; ///< no other strategy can find it
  bool infinite = false;
};

/// What an infinite light sends from a direction, and the density of sampling that direction.
struct RadiancePdf {
  Spectrum radiance; ///< W/(m^2 sr)
  float pdf;         ///< 1/sr
};

/// Of a light at a place. Filled in where it is: copies of what has just been written by parts stall the
/// processor.
inline void set_towards(LightSample& s, const LightSamplingContext& ctx, vec3 point, vec3 point_error,
                        vec3 normal, Spectrum radiance, float pdf) {
  s.direction = glm::normalize(point - ctx.position);
  s.point = point;
  s.point_error = point_error;
  s.point_normal = normal;
  s.radiance = radiance;
  s.pdf = pdf;
}

} // namespace candela
