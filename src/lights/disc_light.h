#pragma once

#include "lights/area_light.h"
#include "sampling/warp.h"

namespace candela {

/// Sampled by area.
struct DiscLight {
  vec3 center{0}, normal{0};
  float radius = 1;
  Spectrum emission{0};
  bool two_sided = false;

  static constexpr std::string_view kName = "disc";
  static constexpr LightKind kind = LightKind::area;

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (!faces(ctx, center, normal, two_sided)) return std::nullopt;
    vec2 d = radius * sample_uniform_disc(u);
    Basis frame = Basis::from_normal(normal);
    vec3 p = center + d.x * frame.s + d.y * frame.t;
    float density = solid_angle_density(ctx, p, normal, area(), two_sided);
    if (!(density > 0)) return std::nullopt;
    std::optional<LightSample> s;
    set_towards(s.emplace(), ctx, p, gamma_bound(6) * (glm::abs(center) + radius), normal, emission, density);
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3 point, vec3) const {
    return solid_angle_density(ctx, point, normal, area(), two_sided);
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
};

} // namespace candela
