#pragma once
// Lights without a scene: what they are made of is kept here.

#include "core/color.h"
#include "lights/light_desc.h"
#include "support/seed.h"

#include <deque>
#include <random>

namespace candela::test {

/// Makes maps and skies and keeps them.
class KeptResources {
public:
  LightResources resources() {
    return {[this](const EnvironmentLightModel& m) { return &maps_.emplace_back(m.panorama, m.mapping); },
            [this](const SkyParameters& p) { return &skies_.emplace_back(make_sky(p)); }};
  }

private:
  std::deque<EnvironmentMap> maps_;
  std::deque<SkyModel> skies_;
};

inline std::mt19937_64 fresh_random(std::uint64_t salt = 0) { return std::mt19937_64(fresh_seed() + salt); }

inline vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return vec3(glm::normalize(glm::dvec3(x, y, z)));
}

/// The power of a luminance by direction, W: midpoints in the cosine to `axis` and in the angle about it.
template <class Intensity>
double integral_over_sphere(Intensity intensity, vec3 axis, int rings = 1500, int turns = 720) {
  const glm::dvec3 z = glm::normalize(glm::dvec3(axis));
  const glm::dvec3 x =
      glm::normalize(glm::cross(z, std::abs(z.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 y = glm::cross(z, x);
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double cosine = 1 - 2 * (i + 0.5) / rings, sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < turns; ++k) {
      const double phi = 2 * std::numbers::pi * (k + 0.5) / turns;
      sum += static_cast<double>(
          luminance(intensity(vec3(cosine * z + sine * (std::cos(phi) * x + std::sin(phi) * y)))));
    }
  }
  return 4 * std::numbers::pi * sum / (static_cast<double>(rings) * turns);
}

/// Whether the light tree gives the direction a share: it may not lose light.
inline bool bounds_reach(const LightBounds& b, vec3 direction) {
  const float angle = std::acos(std::clamp(glm::dot(b.axis, glm::normalize(direction)), -1.0f, 1.0f));
  return angle < b.theta_o + b.theta_e;
}

} // namespace candela::test
