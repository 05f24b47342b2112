#pragma once

#include "lights/area_light.h"
#include "lights/emission_grid.h"
#include "sampling/spherical_rectangle.h"

namespace candela {

/// Sampled in solid angle (Ureña et al. 2013), by area where it covers too little of the sphere for that.
/// One that shows a picture is sampled in proportion to it, too, as one sample of the mixture of both
/// densities (Veach 1997, section 9.2.4): what is bright is found, and where the light is near, or the grid
/// of the picture too coarse, the solid angle bounds the weights.
struct RectangleLight {
  vec3 corner{0}, edge_x{0}, edge_y{0}, normal{0}; ///< edges perpendicular, normal: unit
  vec3 axis_x{0}, axis_y{0};                       ///< unit, along the edges
  float length_x = 0, length_y = 0;
  vec3 point_error{0}; ///< of every point on it
  Spectrum emission{0};
  bool two_sided = false;
  const EmissionGrid* picture = nullptr; ///< over the edges; null where it shines evenly. Somebody else's
  float picture_share = 0;               ///< of samples by the picture, seen from far away

  static constexpr std::string_view kName = "rectangle";
  static constexpr LightKind kind = LightKind::area;

  RectangleLight() = default;
  RectangleLight(vec3 c, vec3 x, vec3 y, Spectrum mean_radiance, bool both_sides,
                 const EmissionGrid* shown = nullptr)
      : corner(c), edge_x(x), edge_y(y), normal(glm::normalize(glm::cross(x, y))), axis_x(glm::normalize(x)),
        axis_y(glm::normalize(y)), length_x(glm::length(x)), length_y(glm::length(y)),
        point_error(flat_point_error(c, x, y)), emission(mean_radiance), two_sided(both_sides),
        picture(shown), picture_share(shown != nullptr ? shown->share_of_samples() : 0) {}

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
    if (picture != nullptr) return sample_picture(ctx, u, seen);
    Point p = point(ctx, u, seen.place(u), seen.solid_angle);
    std::optional<LightSample> s;
    if (p.pdf > 0) set_towards(s.emplace(), ctx, p.position, point_error, normal, emission, p.pdf);
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3 point_on_light, vec3) const {
    if (!faces(ctx, corner, normal, two_sided)) return 0;
    float solid_angle = seen_from(ctx).solid_angle;
    if (picture != nullptr) return picture_pdf(ctx, point_on_light, solid_angle);
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
  /// The nearer the light, the more do distance and cosine differ over it, which samples in solid angle know:
  /// none is by the picture where the light covers a hemisphere.
  float share_seen(float solid_angle) const { return picture_share * (1 - solid_angle / (2 * kPi)); }

  /// One of both ways at random; what is left of the number makes the sample.
  std::optional<LightSample> sample_picture(const LightSamplingContext& ctx, vec2 u,
                                            const SphericalRectangle& seen) const {
    const float share = share_seen(seen.solid_angle);
    vec3 p;
    if (u.x < share) {
      const vec2 place = picture->sample({std::min(u.x / share, kOneMinusEpsilon), u.y});
      p = at(place.x * length_x, place.y * length_y);
    } else {
      u.x = std::min((u.x - share) / (1 - share), kOneMinusEpsilon);
      p = point(ctx, u, seen.place(u), seen.solid_angle).position;
    }
    const float density = picture_pdf(ctx, p, seen.solid_angle);
    std::optional<LightSample> s;
    if (density > 0) set_towards(s.emplace(), ctx, p, point_error, normal, emission, density);
    return s;
  }
  float picture_pdf(const LightSamplingContext& ctx, vec3 p, float solid_angle) const {
    const float by_area = solid_angle_density(ctx, p, normal, area(), two_sided),
                even = solid_angle >= SphericalRectangle::kMinSolidAngle ? 1 / solid_angle : by_area,
                share = share_seen(solid_angle);
    const vec3 d = p - corner;
    const float shown = picture->pdf({glm::dot(d, axis_x) / length_x, glm::dot(d, axis_y) / length_y});
    return (shown > 0 ? share * shown * by_area : 0) + (1 - share) * even;
  }
  SphericalRectangle seen_from(const LightSamplingContext& ctx) const {
    return {corner, axis_x, axis_y, normal, length_x, length_y, ctx.position};
  }
};

} // namespace candela
