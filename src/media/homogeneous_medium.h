#pragma once

#include "core/ray.h"
#include "core/spectrum.h"
#include "media/phase_function.h"
#include "media/tracking_random.h"
#include "media/transmittance_estimate.h"
#include "sampling/sampler.h"

namespace candela {

/// The same everywhere. Absorbs, scatters and sends out light.
struct HomogeneousMedium {
  Spectrum sigma_a{0}; ///< absorption coefficient, 1/scene unit
  Spectrum sigma_s{0}; ///< scattering coefficient, 1/scene unit
  Spectrum emission{
      0}; ///< radiance of a body of it that nothing shines through, if it did not scatter, W/(m^2 sr)
  PhaseFunction phase{};

  Spectrum sigma_t() const { return sigma_a + sigma_s; }
  bool scatters() const { return max_component(sigma_s) > 0; }
  bool emits() const { return max_component(emission * sigma_a) > 0; }

  /// sigma_t times a distance, which may be infinite.
  Spectrum optical_depth(float distance) const { return times_distance(sigma_t(), distance); }
  Spectrum estimate_optical_depth(vec3, vec3, float distance, TrackingRandom&) const {
    return optical_depth(distance);
  }
  /// exp(-sigma_t distance), by Beer and Lambert.
  TransmittanceEstimate transmittance(const Ray&, float distance, const Sampler&) const {
    const Spectrum passes = glm::exp(-optical_depth(distance));
    return {passes, scatters() ? passes : Spectrum(1)};
  }

  /// What arrives at the start of a ray of what its first `distance` sends out: the integral of sigma_a x
  /// emission x exp(-sigma_t t).
  Spectrum emitted(float distance) const {
    const Spectrum t = sigma_t(), depth = optical_depth(distance);
    Spectrum light(0);
    for (int c = 0; c < 3; ++c)
      if (sigma_a[c] > 0) light[c] = emission[c] * sigma_a[c] / t[c] * -std::expm1(-depth[c]);
    return light;
  }

  /// 0 x infinity: nothing happens on an infinite way through nothing.
  static Spectrum times_distance(Spectrum sigma, float distance) {
    Spectrum depth = sigma * distance;
    for (int c = 0; c < 3; ++c)
      if (!(sigma[c] > 0)) depth[c] = 0;
    return depth;
  }
};

} // namespace candela
