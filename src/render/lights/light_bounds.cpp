#include "render/lights/light_bounds.h"

#include "core/color.h"

namespace candela {

namespace {

/// So much wider are cones made (radians), lest rounding take away light that just grazes them.
constexpr float kSlack = 1e-3f;

bool inverse_square(vec3 attenuation) { return attenuation.x == 0 && attenuation.y == 0; }

/// Of what shines by the cosine of the angle to its normal.
LightBounds of_flat(vec3 center, float radius, vec3 normal, vec3 emission, float area, bool two_sided) {
  LightBounds b;
  b.center = center, b.radius = radius, b.axis = normal;
  b.theta_e = 0.5f * kPi;
  b.intensity = static_cast<double>(luminance(emission)) * static_cast<double>(area);
  b.two_sided = two_sided;
  return b;
}

/// Of what shines alike in all directions.
LightBounds of_ball(vec3 center, float radius, double intensity) {
  LightBounds b;
  b.center = center, b.radius = radius;
  b.theta_o = kPi, b.theta_e = 0.5f * kPi;
  b.intensity = intensity;
  b.box.grow(center - radius), b.box.grow(center + radius);
  return b;
}

struct Visitor {
  std::optional<LightBounds> operator()(const TriangleLight& l) const {
    vec3 center = l.corner + (l.edge1 + l.edge2) / 3.0f;
    vec3 corners[3] = {l.corner, l.corner + l.edge1, l.corner + l.edge2};
    float radius2 = 0;
    Bounds3 box;
    for (vec3 c : corners) radius2 = std::max(radius2, length_squared(c - center)), box.grow(c);
    auto b = of_flat(center, std::sqrt(radius2), l.normal, l.emission, l.area, l.two_sided);
    b.box = box;
    return b;
  }
  std::optional<LightBounds> operator()(const RectangleLight& l) const {
    auto b = of_flat(l.corner + 0.5f * (l.edge_x + l.edge_y), 0.5f * glm::length(l.edge_x + l.edge_y),
                     l.normal, l.emission, l.area(), l.two_sided);
    for (vec3 side : {vec3(0), l.edge_y}) b.box.grow(l.corner + side), b.box.grow(l.corner + l.edge_x + side);
    return b;
  }
  std::optional<LightBounds> operator()(const DiscLight& l) const {
    auto b = of_flat(l.center, l.radius, l.normal, l.emission, kPi * sqr(l.radius), l.two_sided);
    vec3 half = l.radius * glm::sqrt(glm::max(1.0f - l.normal * l.normal, 0.0f));
    b.box.grow(l.center - half), b.box.grow(l.center + half);
    return b;
  }
  std::optional<LightBounds> operator()(const SphereLight& l) const {
    return of_ball(l.center, l.radius,
                   static_cast<double>(luminance(l.emission)) * static_cast<double>(kPi * sqr(l.radius)));
  }
  std::optional<LightBounds> operator()(const PointLight& l) const {
    if (!inverse_square(l.attenuation)) return std::nullopt;
    return of_ball(l.position, 0, static_cast<double>(luminance(l.intensity) / l.attenuation.z));
  }
  std::optional<LightBounds> operator()(const SpotLight& l) const {
    if (!inverse_square(l.attenuation)) return std::nullopt;
    LightBounds b = of_ball(l.position, 0, static_cast<double>(luminance(l.intensity) / l.attenuation.z));
    b.axis = l.axis;
    b.theta_o = std::max(l.beam_width, l.cutoff_angle - 0.5f * kPi);
    b.theta_e = std::min(l.cutoff_angle - b.theta_o, 0.5f * kPi);
    b.theta_o = std::min(b.theta_o + kSlack, kPi);
    return b;
  }
  std::optional<LightBounds> operator()(const DirectionalLight&) const { return std::nullopt; }
  std::optional<LightBounds> operator()(const ConstantLight&) const { return std::nullopt; }
  std::optional<LightBounds> operator()(const EnvironmentLight&) const { return std::nullopt; }
};

/// The axis and half-angle of a cone around both.
void merge_cones(const LightBounds& a, const LightBounds& b, LightBounds& to) {
  const LightBounds &wide = a.theta_o >= b.theta_o ? a : b, &narrow = a.theta_o >= b.theta_o ? b : a;
  to.axis = wide.axis;
  to.theta_o = wide.theta_o;
  if (wide.theta_o >= kPi) return;
  float cosine = glm::dot(wide.axis, narrow.axis);
  vec3 across = narrow.axis - cosine * wide.axis;
  float sine = glm::length(across), between = std::atan2(sine, cosine);
  if (between + narrow.theta_o <= wide.theta_o) return;
  float theta = 0.5f * (wide.theta_o + between + narrow.theta_o);
  if (theta + kSlack >= kPi || sine < 1e-4f * std::abs(cosine)) { // all, or axes that are (anti)parallel
    to.theta_o = cosine > 0 ? std::min(theta + 2 * kSlack, kPi) : kPi;
    return;
  }
  float turn = theta - wide.theta_o;
  to.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * (across / sine));
  to.theta_o = theta + kSlack;
}

} // namespace

std::optional<LightBounds> light_bounds(const Light& light) { return std::visit(Visitor{}, light); }

LightBounds merge(const LightBounds& a, const LightBounds& b) {
  LightBounds both;
  both.box = a.box;
  both.box.grow(b.box);
  both.center = both.box.center();
  both.radius = 0.5f * glm::length(both.box.diagonal());
  merge_cones(a, b, both);
  both.theta_e = std::max(a.theta_e, b.theta_e);
  both.intensity = a.intensity + b.intensity;
  both.two_sided = a.two_sided || b.two_sided;
  return both;
}

double spread(const LightBounds& b) {
  auto o = static_cast<double>(b.theta_o), w = std::min(o + static_cast<double>(b.theta_e), std::numbers::pi);
  double directions =
      2 * std::numbers::pi * (1 - std::cos(o)) +
      std::numbers::pi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
  return b.intensity * directions * static_cast<double>(length_squared(b.box.diagonal()));
}

} // namespace candela
