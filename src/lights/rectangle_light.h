#pragma once

#include "lights/area_light.h"
#include "sampling/spherical_rectangle.h"

namespace candela {

/// Sampled in solid angle (Ureña et al. 2013), by area where it covers too little of the sphere for that.
struct RectangleLight {
  vec3 corner{0}, edge_x{0}, edge_y{0}, normal{0}; ///< edges perpendicular, normal: unit
  vec3 axis_x{0}, axis_y{0};                       ///< unit, along the edges
  float length_x = 0, length_y = 0;
  vec3 point_error{0}; ///< of every point on it
  Spectrum emission{0};
  bool two_sided = false;

  static constexpr std::string_view kName = "rectangle";
  static constexpr LightKind kind = LightKind::area;

  RectangleLight() = default;
  RectangleLight(vec3 c, vec3 x, vec3 y, Spectrum radiance, bool both_sides)
      : corner(c), edge_x(x), edge_y(y), normal(glm::normalize(glm::cross(x, y))), axis_x(glm::normalize(x)),
        axis_y(glm::normalize(y)), length_x(glm::length(x)), length_y(glm::length(y)),
        point_error(flat_point_error(c, x, y)), emission(radiance), two_sided(both_sides) {}

  float area() const { return length_x * length_y; }
  vec3 at(float x, float y) const { return corner + x * axis_x + y * axis_y; }

  /// A place on the light and its density in 1/sr, which is 0 if there is none.
  struct Point {
    vec3 position;
    float pdf;
  };
  /// At `place`, along the edges, if the light covers enough of the sphere; else by area. For one sample, or
  /// for loops over many.
  [[gnu::always_inline]] Point point(const LightSamplingContext& ctx, vec2 u, vec2 place,
                                     float solid_angle) const {
    if (solid_angle >= SphericalRectangle::kMinSolidAngle) return {at(place.x, place.y), 1 / solid_angle};
    vec3 p = at(u.x * length_x, u.y * length_y);
    return {p, solid_angle_density(ctx, p, normal, area(), two_sided)};
  }

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (!faces(ctx, corner, normal, two_sided)) return std::nullopt;
    SphericalRectangle seen = seen_from(ctx);
    Point p = point(ctx, u, seen.place(u), seen.solid_angle);
    std::optional<LightSample> s;
    if (p.pdf > 0) set_towards(s.emplace(), ctx, p.position, point_error, normal, emission, p.pdf);
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3 point_on_light, vec3) const {
    if (!faces(ctx, corner, normal, two_sided)) return 0;
    float solid_angle = seen_from(ctx).solid_angle;
    if (solid_angle >= SphericalRectangle::kMinSolidAngle) return 1 / solid_angle;
    return solid_angle_density(ctx, point_on_light, normal, area(), two_sided);
  }
  float power(float) const { return area_light_power(emission, area(), two_sided); }
  std::optional<LightBounds> bounds() const {
    auto b = flat_light_bounds(corner + 0.5f * (edge_x + edge_y), 0.5f * glm::length(edge_x + edge_y), normal,
                               emission, area(), two_sided);
    for (vec3 side : {vec3(0), edge_y}) b.box.grow(corner + side), b.box.grow(corner + edge_x + side);
    return b;
  }

private:
  SphericalRectangle seen_from(const LightSamplingContext& ctx) const {
    return {corner, axis_x, axis_y, normal, length_x, length_y, ctx.position};
  }
};

} // namespace candela
