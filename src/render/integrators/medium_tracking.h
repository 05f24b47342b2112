#pragma once
// Where paths collide in media that are not the same everywhere: delta tracking with the bricks' majorants.
//
// Tentative collisions lie as thick as if a brick were everywhere as dense as at its densest place. One is
// real with the probability extinction / majorant; else it is a null collision, and the ray continues
// (Woodcock et al. 1965). One ray carries all channels: with f, the contribution of what has happened so far,
// and q, its density as each channel alone would have it, both per channel, the weight is f over the mixture
// of q by the channels' probabilities (Miller, Georgiev & Jarosz 2019, "A Null-Scattering Path Integral
// Formulation of Light Transport", section 5). Media without grids on the same ray take their part in closed
// form.

#include "render/integrators/medium_way.h"

namespace candela {

/// What becomes of a path on a ray.
struct TrackedWay {
  struct Collision {
    const MediumSegment* segment;
    float distance; ///< along the ray, scene units
    vec3 position;
    Spectrum weight; ///< of the path that scatters there: scattering coefficient x transmittance / density
  };
  std::optional<Collision> collision;
  Spectrum weight{1};      ///< of the path that comes through, where there is no collision
  Spectrum unscattered{1}; ///< likewise, as MediumPoint has it
  Spectrum emitted{0};     ///< radiance that the way is found to send to its start
};

/// Follows the ray up to a collision, or to its end; if not `collides` there is none, and the weight is an
/// estimate of the transmittance. `channels` are as channel_probabilities() has them.
TrackedWay track(const MediumWay& way, Spectrum channels, bool collides, TrackingRandom& random);

/// The estimate of what the way's grids let pass up to that distance, but for their absorption coefficient.
Spectrum track_transmittance(const MediumWay& way, float distance, TrackingRandom& random);

} // namespace candela
