#pragma once

#include "lights/area_light.h"
#include "lights/emission_grid.h"
#include "sampling/warp.h"

namespace candela {

/// Sampled by area. One that shows a picture is sampled in proportion to it, too, as RectangleLight.
struct DiscLight {
  vec3 center{0}, normal{0};
  float radius = 1;
  Spectrum emission{0};
  bool two_sided = false;
  const EmissionGrid* picture = nullptr; ///< by polar(); null where it shines evenly. Somebody else's
  vec3 axis_x{0}, axis_y{0};             ///< of the picture: unit, perpendicular to the normal
  float picture_share = 0;               ///< of samples by the picture, seen from far away

  static constexpr std::string_view kName = "disc";
  static constexpr LightKind kind = LightKind::area;

  /// Equal areas of the unit square to equal areas of the unit disc, and back: the square of the radius, and
  /// the angle in turns.
  static vec2 from_polar(vec2 q) {
    const float r = std::sqrt(q.x), phi = 2 * kPi * q.y;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  static vec2 polar(vec2 d) {
    const float turns = std::atan2(d.y, d.x) * (0.5f * kInvPi);
    return {glm::dot(d, d), turns < 0 ? turns + 1 : turns};
  }
  void set_picture(const EmissionGrid* shown, vec3 x, vec3 y) {
    picture = shown, axis_x = x, axis_y = y;
    picture_share = shown != nullptr ? shown->share_of_samples() : 0;
  }

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (!faces(ctx, center, normal, two_sided)) return std::nullopt;
    vec3 p;
    if (const float share = picture != nullptr ? share_seen(ctx) : 0; u.x < share) {
      const vec2 d = radius * from_polar(picture->sample({std::min(u.x / share, kOneMinusEpsilon), u.y}));
      p = center + d.x * axis_x + d.y * axis_y;
    } else {
      if (share > 0) u.x = std::min((u.x - share) / (1 - share), kOneMinusEpsilon);
      vec2 d = radius * sample_uniform_disc(u);
      Basis frame = Basis::from_normal(normal);
      p = center + d.x * frame.s + d.y * frame.t;
    }
    const float density = pdf(ctx, p, {});
    if (!(density > 0)) return std::nullopt;
    std::optional<LightSample> s;
    set_towards(s.emplace(), ctx, p, gamma_bound(6) * (glm::abs(center) + radius), normal, emission, density);
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3 point, vec3) const {
    const float even = solid_angle_density(ctx, point, normal, area(), two_sided);
    if (picture == nullptr) return even;
    const vec3 d = (point - center) / radius;
    const float share = share_seen(ctx),
                shown = picture->pdf(polar({glm::dot(d, axis_x), glm::dot(d, axis_y)}));
    return even * (share * shown + (1 - share));
  }
  float power(float) const { return area_light_power(emission, area(), two_sided); }
  std::optional<LightBounds> bounds() const {
    auto b = flat_light_bounds(center, radius, normal, emission, area(), two_sided);
    vec3 half = radius * glm::sqrt(glm::max(1.0f - normal * normal, 0.0f));
    b.box.grow(center - half), b.box.grow(center + half);
    return b;
  }

private:
  float area() const { return kPi * sqr(radius); }
  /// The less, the more distance and cosine differ over it: none where it covers a hemisphere.
  float share_seen(const LightSamplingContext& ctx) const {
    const float distance2 = length_squared(center - ctx.position);
    return picture_share * std::sqrt(distance2 / (distance2 + sqr(radius)));
  }
};

} // namespace candela
