#include "render/onward.h"

namespace candela {

Roulette Roulette::at(const PathSettings& settings, int depth) {
  if (settings.rr == RussianRoulette::off || depth < settings.rr_depth) return {};
  if (settings.rr == RussianRoulette::fixed) return {settings.rr_probability, kInfinity};
  return {0, settings.rr_threshold};
}

namespace {

[[gnu::noinline]] void choose_all(const VertexLanes& __restrict vertices, Roulette roulette,
                                  OnwardLanes& __restrict out) {
  for (std::size_t i = 0; i < vertices.count; ++i) {
    vec3 outside = vertices.geometric_normal[i], local = out.wi_local[i];
    vec3 wi = Basis::from_normal(vertices.normal[i]).to_world(local);
    // The interpolated normal may take it through the surface.
    bool keeps_side =
        (glm::dot(wi, outside) * vertices.side[i] > 0) == (local.z * vertices.wo_local.z[i] > 0);
    vec3 carried = out.throughput[i];
    float largest = max_component(carried);
    float worth = largest * out.unscaled[i] / roulette.threshold;
    float q = worth < 1 ? std::max(worth, roulette.least) : 1.0f; // NaN goes on, to be seen
    // Nothing, or less than a normal float: rounding would keep denormals alive for ever where reflectance is
    // above 1/2.
    q = largest < std::numeric_limits<float>::min() ? 0.0f : q;
    out.throughput.set(i, carried / q);
    out.direction.set(i, wi);
    out.origin.set(i, offset_ray_origin(vertices.position[i], vertices.position_error[i], outside, wi));
    out.goes_on[i] = static_cast<int>(keeps_side) & static_cast<int>(out.u[i] < q);
  }
}

} // namespace

void OnwardLanes::choose(const VertexLanes& vertices, const Roulette& roulette) {
  choose_all(vertices, roulette, *this);
}

} // namespace candela
