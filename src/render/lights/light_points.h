#pragma once
// Places on lights, for one sample or for loops over many.

#include "render/lights/light.h"

namespace candela {

/// From density per area to density per solid angle: r^2 / |cos theta|; 0 where the light is edge-on or shows
/// the side that does not shine.
inline float solid_angle_density(const LightReference& ref, vec3 point, vec3 normal, float area,
                                 bool two_sided) {
  vec3 d = point - ref.position;
  float distance2 = length_squared(d);
  float cosine = -glm::dot(normal, d); // times the distance
  if (two_sided) cosine = std::abs(cosine);
  if (!(cosine > 0) || !(distance2 > 0)) return 0;
  return distance2 * std::sqrt(distance2) / (cosine * area);
}

inline bool faces(const LightReference& ref, vec3 corner, vec3 normal, bool two_sided) {
  return two_sided || glm::dot(ref.position - corner, normal) > 0;
}

inline vec3 place_on(const RectangleLight& light, float x, float y) {
  return light.corner + x * light.axis_x + y * light.axis_y;
}

/// A place on the light and its density in 1/sr, which is 0 if there is none.
struct RectanglePoint {
  vec3 position;
  float pdf;
};
/// At `place`, along the edges, if the light covers enough of the sphere; else by area.
[[gnu::always_inline]] inline RectanglePoint point_on(const RectangleLight& light, const LightReference& ref,
                                                      vec2 u, vec2 place, float solid_angle) {
  if (solid_angle >= SphericalRectangle::kMinSolidAngle)
    return {place_on(light, place.x, place.y), 1 / solid_angle};
  vec3 p = place_on(light, u.x * light.length_x, u.y * light.length_y);
  return {p, solid_angle_density(ref, p, light.normal, light.area(), light.two_sided)};
}

/// Of the cone that a sphere covers.
struct SpherePoint {
  vec3 normal; ///< unit, outwards: the place on the sphere
  float pdf;   ///< 1/sr
};
/// Uniform in the solid angle that a sphere covers whose centre is at `to_center`, farther than its radius
/// (pbrt-v4, section 6.2.4, the angle at the centre without cancellation for small cones). Without branches.
[[gnu::always_inline]] inline SpherePoint point_towards(vec3 to_center, float radius, vec2 u) {
  float distance2 = length_squared(to_center);
  float sin2_max = sqr(radius) / distance2;
  float one_minus_cos_max = one_minus_cos_from_sin2(sin2_max);
  vec3 local = sample_uniform_cone(u, one_minus_cos_max); // about the direction to the centre
  float cos_theta = local.z;
  float sin2_theta = select(sin2_max < 1e-3f, local.x * local.x + local.y * local.y, 1 - sqr(cos_theta));
  // At the centre, from the reference's side:
  float cos_alpha = sin2_theta / std::sqrt(sin2_max) + cos_theta * safe_sqrt(1 - sin2_theta / sin2_max);
  float sin_alpha = safe_sqrt(1 - sqr(cos_alpha));
  float sin_theta = safe_sqrt(sin2_theta);
  float scale = sin_alpha / select(sin_theta > 0, sin_theta, 1.0f); // of x and y, which are 0 there, too
  Basis frame = Basis::from_normal(to_center / std::sqrt(distance2));
  vec3 n = frame.to_world({local.x * scale, local.y * scale, -cos_alpha});
  return {glm::normalize(n), uniform_cone_pdf(one_minus_cos_max)};
}
/// Of the point at `offset` from the centre.
inline vec3 sphere_point_error(vec3 center, vec3 offset) {
  return gamma_bound(6) * (glm::abs(center) + glm::abs(offset));
}

} // namespace candela
