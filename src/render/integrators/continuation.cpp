#include "render/integrators/continuation.h"

namespace candela {

namespace {

[[gnu::noinline]] void compute_all(const VertexLanes& __restrict vertices, Roulette roulette,
                                   ContinuationLanes& __restrict out) {
  for (std::size_t i = 0; i < vertices.count; ++i) {
    vec3 outside = vertices.geometric_normal[i], local = out.wi_local[i];
    vec3 wi = Basis::from_normal(vertices.normal[i]).to_world(local);
    // The interpolated normal may take it through the surface.
    float along = glm::dot(wi, outside);
    bool keeps_side = (along * vertices.side[i] > 0) == (local.z * vertices.wo_local.z[i] > 0);
    // As factors, for the compiler gives up the vector code where integers choose among floats.
    float fold = keeps_side ? 0.0f : out.folds[i];
    wi = wi - 2 * fold * along * outside;
    Spectrum carried = out.throughput[i];
    float largest = max_component(carried);
    float relative = largest * out.eta_scale[i] / roulette.threshold;
    float q = relative < 1 ? std::max(relative, roulette.min_survival) : 1.0f; // NaN continues, to be seen
    q = std::min(q, roulette.max_survival);
    // Nothing, or less than a normal float: rounding would keep denormals alive for ever where reflectance is
    // above 1/2.
    q = largest < std::numeric_limits<float>::min() ? 0.0f : q;
    out.throughput.set(i, carried / q);
    out.direction.set(i, wi);
    out.origin.set(i, offset_ray_origin(vertices.position[i], vertices.position_error[i], outside, wi));
    out.survives[i] = static_cast<int>(out.u[i] < (keeps_side ? q : q * out.folds[i]));
  }
}

} // namespace

void ContinuationLanes::compute(const VertexLanes& vertices, const Roulette& roulette) {
  compute_all(vertices, roulette, *this);
}

} // namespace candela
