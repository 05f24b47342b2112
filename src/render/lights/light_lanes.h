#pragma once
// Vectorised samples of many lights.

#include "core/lanes.h"
#include "lights/light.h"

#include <span>

namespace candela {

/// One of many light samples.
struct LightQuery {
  const Light* light;
  const LightSamplingContext* context;
  vec2 u;
  std::uint32_t lane; ///< where the sample goes; no two the same
};

/// What LightSample is of one.
struct LightSampleLanes {
  Lanes<float> pdf; ///< 0: the light cannot be seen
  Vec3Lanes point, point_error, point_normal;
  Vec3Lanes direction; ///< of infinite lights; to the others it is that of `point`
  Vec3Lanes radiance;
  Lanes<std::int32_t> infinite; ///< 1 or 0
  Lanes<bool> delta;

  void set(std::size_t i, const std::optional<LightSample>& sample);
  /// Of a light with a surface.
  void set_area(std::size_t i, float density, vec3 place, vec3 error, vec3 normal, Spectrum emission);
};

/// sample_light() of up to kLaneCount, to the bit. Rectangles and spheres are done side by side by the vector
/// unit: rectangles in a third of the time; with spheres (and the light tree's importance, which was scalar
/// until then) the plates of tests/bench/versus_cycles got 1.5 times as many samples a second.
void sample_lights(std::span<const LightQuery> queries, LightSampleLanes& samples);

} // namespace candela
