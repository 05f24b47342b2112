#pragma once

#include "lights/area_light.h"
#include "lights/emission_grid.h"
#include "sampling/warp.h"

namespace candela {

/// Sampled in the cone that it covers; from inside (two-sided only) by area. One that shows a picture is
/// sampled in proportion to it, too, as RectangleLight.
struct SphereLight {
  vec3 center{0};
  float radius = 1;
  Spectrum emission{0};
  bool two_sided = false;
  const EmissionGrid* picture = nullptr; ///< by square_of(); null where it shines evenly. Somebody else's
  mat3 local_from_world{1.0f};           ///< turns (and mirrors) directions to those of the picture
  float picture_share = 0;               ///< of samples by the picture, seen from far away

  static constexpr std::string_view kName = "sphere";
  static constexpr LightKind kind = LightKind::area;

  /// Of the cone that a sphere covers.
  struct Point {
    vec3 normal; ///< unit, outwards: the place on the sphere
    float pdf;   ///< 1/sr
  };
  static Point point_towards(vec3 to_center, float radius, vec2 u);
  /// Of the point at `offset` from the centre.
  static vec3 point_error(vec3 center, vec3 offset) {
    return gamma_bound(6) * (glm::abs(center) + glm::abs(offset));
  }

  /// Equal areas of the unit square to equal areas of the unit sphere, and back: the longitude in turns, and
  /// the height from the south pole.
  static vec3 from_square(vec2 q) {
    const float phi = 2 * kPi * q.x, z = 2 * q.y - 1, r = safe_sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  static vec2 square_of(vec3 d) {
    const float turns = std::atan2(d.y, d.x) * (0.5f * kInvPi);
    return {turns < 0 ? turns + 1 : turns, 0.5f * (d.z + 1)};
  }
  void set_picture(const EmissionGrid* shown, const mat3& local) {
    picture = shown, local_from_world = local;
    picture_share = shown != nullptr ? shown->share_of_samples() : 0;
  }

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (picture != nullptr) return sample_picture(ctx, u);
    return sample_even(ctx, u);
  }
  float pdf(const LightSamplingContext& ctx, vec3 point, vec3) const {
    const float even = even_pdf(ctx, point);
    return picture != nullptr && even > 0 ? picture_pdf(ctx, point, even) : even;
  }
  float power(float) const { return area_light_power(emission, area(), two_sided); }
  std::optional<LightBounds> bounds() const {
    return omnidirectional_bounds(
        center, radius, static_cast<double>(luminance(emission)) * static_cast<double>(kPi * sqr(radius)));
  }

private:
  std::optional<LightSample> sample_even(const LightSamplingContext& ctx, vec2 u) const {
    vec3 to_center = center - ctx.position;
    Point p;
    if (length_squared(to_center) > sqr(radius)) {
      p = point_towards(to_center, radius, u);
    } else {
      if (!two_sided) return std::nullopt;
      p.normal = sample_uniform_sphere(u);
      p.pdf = solid_angle_density(ctx, center + radius * p.normal, p.normal, area(), true);
      if (!(p.pdf > 0)) return std::nullopt;
    }
    vec3 offset = radius * p.normal;
    std::optional<LightSample> s;
    set_towards(s.emplace(), ctx, center + offset, point_error(center, offset), p.normal, emission, p.pdf);
    return s;
  }
  float even_pdf(const LightSamplingContext& ctx, vec3 point) const {
    float distance2 = length_squared(center - ctx.position), radius2 = sqr(radius);
    if (distance2 > radius2) return uniform_cone_pdf(one_minus_cos_from_sin2(radius2 / distance2));
    if (!two_sided) return 0;
    return solid_angle_density(ctx, point, (point - center) / radius, area(), true);
  }

  /// The picture is that of the whole sphere. From outside less than half of it is seen, and the less, the
  /// nearer the point.
  float share_seen(const LightSamplingContext& ctx) const {
    const float distance = glm::length(center - ctx.position);
    return distance > radius ? picture_share * (1 - radius / distance) : picture_share;
  }
  std::optional<LightSample> sample_picture(const LightSamplingContext& ctx, vec2 u) const {
    const float share = share_seen(ctx);
    std::optional<LightSample> s;
    if (u.x < share) {
      const vec2 place = picture->sample({std::min(u.x / share, kOneMinusEpsilon), u.y});
      const vec3 normal = from_square(place) * local_from_world, offset = radius * normal;
      const bool outside = length_squared(center - ctx.position) > sqr(radius);
      if (outside && !(glm::dot(ctx.position - (center + offset), normal) > 0)) return std::nullopt;
      const float density = pdf(ctx, center + offset, {});
      if (density > 0)
        set_towards(s.emplace(), ctx, center + offset, point_error(center, offset), normal, emission,
                    density);
      return s;
    }
    s = sample_even(ctx, {std::min((u.x - share) / (1 - share), kOneMinusEpsilon), u.y});
    if (s) s->pdf = picture_pdf(ctx, s->point, s->pdf);
    return s;
  }
  /// Of a point that is seen, which has this density without a picture.
  float picture_pdf(const LightSamplingContext& ctx, vec3 point, float even) const {
    const vec3 normal = glm::normalize(point - center);
    const float share = share_seen(ctx), by_area = solid_angle_density(ctx, point, normal, area(), two_sided),
                shown = picture->pdf(square_of(local_from_world * normal));
    return (shown > 0 ? share * shown * by_area : 0) + (1 - share) * even;
  }
  float area() const { return 4 * kPi * sqr(radius); }
};

/// Uniform in the solid angle that a sphere covers whose centre is at `to_center`, farther than its radius
/// (pbrt-v4, section 6.2.4, the angle at the centre without cancellation for small cones). Without branches,
/// for one sample or for loops over many.
[[gnu::always_inline]] inline SphereLight::Point SphereLight::point_towards(vec3 to_center, float radius,
                                                                            vec2 u) {
  float distance2 = length_squared(to_center);
  float sin2_max = sqr(radius) / distance2;
  float one_minus_cos_max = one_minus_cos_from_sin2(sin2_max);
  vec3 local = sample_uniform_cone(u, one_minus_cos_max); // about the direction to the centre
  float cos_theta = local.z;
  float sin2_theta = select(sin2_max < 1e-3f, local.x * local.x + local.y * local.y, 1 - sqr(cos_theta));
  // At the centre, from the shading point's side:
  float cos_alpha = sin2_theta / std::sqrt(sin2_max) + cos_theta * safe_sqrt(1 - sin2_theta / sin2_max);
  float sin_alpha = safe_sqrt(1 - sqr(cos_alpha));
  float sin_theta = safe_sqrt(sin2_theta);
  float scale = sin_alpha / select(sin_theta > 0, sin_theta, 1.0f); // of x and y, which are 0 there, too
  Basis frame = Basis::from_normal(to_center / std::sqrt(distance2));
  vec3 n = frame.to_world({local.x * scale, local.y * scale, -cos_alpha});
  return {glm::normalize(n), uniform_cone_pdf(one_minus_cos_max)};
}

} // namespace candela
