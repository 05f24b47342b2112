#pragma once

#include "lights/area_light.h"
#include "sampling/warp.h"

namespace candela {

/// Sampled by area.
struct TriangleLight {
  vec3 corner{0}, edge1{0}, edge2{0}, normal{0}; ///< normal: unit
  float area = 0;
  Spectrum emission{0};
  bool two_sided = false;

  static constexpr std::string_view kName = "triangle";
  static constexpr LightKind kind = LightKind::area;

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    if (!faces(ctx, corner, normal, two_sided)) return std::nullopt;
    vec3 b = sample_uniform_triangle(u);
    vec3 p = corner + b.y * edge1 + b.z * edge2;
    float density = solid_angle_density(ctx, p, normal, area, two_sided);
    if (!(density > 0)) return std::nullopt;
    std::optional<LightSample> s;
    set_towards(s.emplace(), ctx, p, flat_point_error(corner, edge1, edge2), normal, emission, density);
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3 point, vec3) const {
    return solid_angle_density(ctx, point, normal, area, two_sided);
  }
  float power(float) const { return area_light_power(emission, area, two_sided); }
  std::optional<LightBounds> bounds() const {
    vec3 center = corner + (edge1 + edge2) / 3.0f;
    vec3 corners[3] = {corner, corner + edge1, corner + edge2};
    float radius2 = 0;
    Bounds3 box;
    for (vec3 c : corners) radius2 = std::max(radius2, length_squared(c - center)), box.grow(c);
    auto b = flat_light_bounds(center, std::sqrt(radius2), normal, emission, area, two_sided);
    b.box = box;
    return b;
  }
};

} // namespace candela
