#include "render/onward.h"

namespace candela {

Roulette Roulette::at(const PathSettings& settings, int depth) {
  if (settings.rr == RussianRoulette::off || depth < settings.rr_depth) return {};
  if (settings.rr == RussianRoulette::fixed) return {settings.rr_probability, kInfinity};
  return {0, settings.rr_threshold};
}

void OnwardLanes::choose(const Roulette& r) {
  const Roulette roulette = r; // that stores cannot reach
  for (std::size_t i = 0; i < count; ++i) {
    vec3 outside = geometric_normal[i];
    vec3 wi = Basis::from_normal(normal[i]).to_world(local[i]);
    // The interpolated normal may take it through the surface.
    const float kept = glm::dot(wi, outside) * side[i];
    vec3 carried = throughput[i];
    const float largest = max_component(carried);
    float q = std::min(std::max(largest * unscaled[i] / roulette.threshold, roulette.least), 1.0f);
    // Nothing, or less than a normal float: rounding would keep denormals alive for ever where reflectance is
    // above 1/2.
    q = largest < std::numeric_limits<float>::min() ? 0.0f : q;
    throughput.set(i, carried / q);
    direction.set(i, wi);
    origin.set(i, offset_ray_origin(position[i], position_error[i], outside, wi));
    goes_on[i] = static_cast<int>((kept > 0) == (cosines[i] > 0)) & static_cast<int>(u[i] < q);
  }
}

} // namespace candela
