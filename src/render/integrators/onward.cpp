#include "render/integrators/onward.h"

namespace candela {

float survival_bound(int depth) {
  // Measured by relMSE x samples: the white room, all of whose surfaces are lossless, gets 0.6 % noisier by
  // it and the inside of a lossless box with one small opening twice as noisy (0.95 instead of 0.99: 17
  // times), at 14 % fewer rays; a camera in a ball of glass, whose paths would never end, traces 160 rays a
  // sample.
  constexpr int kFreeDepth = 64;
  return depth < kFreeDepth ? 1 : 0.99f;
}

Roulette Roulette::at(const PathSettings& settings, int depth) {
  if (settings.rr == RussianRoulette::off) return {};
  const float most = survival_bound(depth);
  if (depth < settings.rr_depth) return {1, kInfinity, most};
  if (settings.rr == RussianRoulette::fixed) return {settings.rr_probability, kInfinity, most};
  return {0, settings.rr_threshold, most};
}

namespace {

[[gnu::noinline]] void choose_all(const VertexLanes& __restrict vertices, Roulette roulette,
                                  OnwardLanes& __restrict out) {
  for (std::size_t i = 0; i < vertices.count; ++i) {
    vec3 outside = vertices.geometric_normal[i], local = out.wi_local[i];
    vec3 wi = Basis::from_normal(vertices.normal[i]).to_world(local);
    // The interpolated normal may take it through the surface.
    float along = glm::dot(wi, outside);
    bool keeps_side = (along * vertices.side[i] > 0) == (local.z * vertices.wo_local.z[i] > 0);
    // As factors, for the compiler gives up the vector code where integers choose among floats.
    float fold = keeps_side ? 0.0f : out.folds[i];
    wi = wi - 2 * fold * along * outside;
    vec3 carried = out.throughput[i];
    float largest = max_component(carried);
    float worth = largest * out.unscaled[i] / roulette.threshold;
    float q = worth < 1 ? std::max(worth, roulette.least) : 1.0f; // NaN goes on, to be seen
    q = std::min(q, roulette.most);
    // Nothing, or less than a normal float: rounding would keep denormals alive for ever where reflectance is
    // above 1/2.
    q = largest < std::numeric_limits<float>::min() ? 0.0f : q;
    out.throughput.set(i, carried / q);
    out.direction.set(i, wi);
    out.origin.set(i, offset_ray_origin(vertices.position[i], vertices.position_error[i], outside, wi));
    out.goes_on[i] = static_cast<int>(out.u[i] < (keeps_side ? q : q * out.folds[i]));
  }
}

} // namespace

void OnwardLanes::choose(const VertexLanes& vertices, const Roulette& roulette) {
  choose_all(vertices, roulette, *this);
}

} // namespace candela
