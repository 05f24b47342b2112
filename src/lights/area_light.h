#pragma once
// What lights with a surface have in common.

#include "core/color.h"
#include "lights/light_bounds.h"
#include "lights/light_sample.h"

namespace candela {

/// From density per area to density per solid angle: r^2 / |cos theta|; 0 where the light is edge-on or shows
/// the side that does not shine.
inline float solid_angle_density(const LightSamplingContext& ctx, vec3 point, vec3 normal, float area,
                                 bool two_sided) {
  vec3 d = point - ctx.position;
  float distance2 = length_squared(d);
  float cosine = -glm::dot(normal, d); // times the distance
  if (two_sided) cosine = std::abs(cosine);
  if (!(cosine > 0) || !(distance2 > 0)) return 0;
  return distance2 * std::sqrt(distance2) / (cosine * area);
}

/// Whether a flat light through `corner` shows the point a side that shines.
inline bool faces(const LightSamplingContext& ctx, vec3 corner, vec3 normal, bool two_sided) {
  return two_sided || glm::dot(ctx.position - corner, normal) > 0;
}

/// Of a point of a flat light: its own error, and the rounding of its surface's intersection test as in
/// Geometry::surface.
inline vec3 flat_point_error(vec3 corner, vec3 edge1, vec3 edge2) {
  return gamma_bound(6) * (glm::abs(corner) + glm::abs(edge1) + glm::abs(edge2)) +
         gamma_bound(8) * max_component(glm::max(glm::abs(edge1), glm::abs(edge2)));
}

/// W of a surface of constant radiance.
inline float area_light_power(Spectrum emission, float area, bool two_sided) {
  return luminance(emission) * area * kPi * (two_sided ? 2.0f : 1.0f);
}

/// Of a flat light, but for its box.
inline LightBounds flat_light_bounds(vec3 center, float radius, vec3 normal, Spectrum emission, float area,
                                     bool two_sided) {
  LightBounds b;
  b.center = center, b.radius = radius, b.axis = normal;
  b.theta_e = 0.5f * kPi;
  b.intensity = static_cast<double>(luminance(emission)) * static_cast<double>(area);
  b.two_sided = two_sided;
  return b;
}

} // namespace candela
