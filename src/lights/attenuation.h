#pragma once

#include "lights/light_sample.h"

namespace candela {

/// How the light of a point falls off with the distance: LightDesc::attenuation.
struct Attenuation {
  /// Divides by x + y r + z r^2 of the distance r.
  vec3 coefficients{0, 0, 1};

  bool inverse_square() const { return coefficients.x == 0 && coefficients.y == 0; }
  template <class T>
  T divisor(T r) const {
    T a(coefficients.x), b(coefficients.y), c(coefficients.z);
    return a + b * r + c * (r * r);
  }
  /// How many times stronger a light is at the distance r than one that falls with the square is.
  float relative_to_inverse_square(float r) const {
    auto d = static_cast<double>(r);
    return static_cast<float>(d * d / divisor(d));
  }
  /// Of a light at `position` whose intensity towards the shading point is `intensity`.
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec3 position,
                                    Spectrum intensity) const {
    float distance2 = length_squared(position - ctx.position);
    if (!(distance2 > 0)) return std::nullopt;
    float by = coefficients.z * distance2;
    if (!inverse_square()) by = divisor(std::sqrt(distance2));
    std::optional<LightSample> s;
    set_towards(s.emplace(), ctx, position, vec3(0), vec3(0), intensity / by, 1);
    s->delta = true;
    return s;
  }
};

} // namespace candela
