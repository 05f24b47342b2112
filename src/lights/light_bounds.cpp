#include "lights/light_bounds.h"

#include "core/math.h"

#include <numbers>

namespace candela {

namespace {

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
  if (theta + kBoundsConeSlack >= kPi ||
      sine < 1e-4f * std::abs(cosine)) { // all, or axes that are (anti)parallel
    to.theta_o = cosine > 0 ? std::min(theta + 2 * kBoundsConeSlack, kPi) : kPi;
    return;
  }
  float turn = theta - wide.theta_o;
  to.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * (across / sine));
  to.theta_o = theta + kBoundsConeSlack;
}

} // namespace

LightBounds omnidirectional_bounds(vec3 center, float radius, double intensity) {
  LightBounds b;
  b.center = center, b.radius = radius;
  b.theta_o = kPi, b.theta_e = 0.5f * kPi;
  b.intensity = intensity;
  b.box.grow(center - radius), b.box.grow(center + radius);
  return b;
}

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

double saoh_cost(const LightBounds& b) {
  auto o = static_cast<double>(b.theta_o), w = std::min(o + static_cast<double>(b.theta_e), std::numbers::pi);
  double directions =
      2 * std::numbers::pi * (1 - std::cos(o)) +
      std::numbers::pi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
  return b.intensity * directions * static_cast<double>(length_squared(b.box.diagonal()));
}

} // namespace candela
