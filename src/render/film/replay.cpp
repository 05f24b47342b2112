#include "render/film/replay.h"

namespace candela {

vec3 replay_sample(const RenderScene& scene, const Document& document, uvec2 pixel, std::uint32_t sample) {
  return PixelSampler(scene, document, {}).sample({pixel, sample}).value;
}

// A sum that is not finite stays so when terms are added: so the depth is doubled and then bisected.
int nonfinite_depth(const PassJob& job, const SampleIndex& index) {
  Document limited = job.document;
  auto is_finite_up_to = [&](int depth) {
    limited.settings.path.max_depth = depth;
    return is_finite(PixelSampler(job.scene, limited, {}, job.camera).sample(index).value);
  };
  int finite = 0, last = 1;
  constexpr int kMost = 1 << 20;
  while (is_finite_up_to(last)) {
    if (last >= kMost) return 0;
    finite = last;
    last *= 2;
  }
  while (last - finite > 1) {
    const int middle = finite + (last - finite) / 2;
    (is_finite_up_to(middle) ? finite : last) = middle;
  }
  return last;
}

} // namespace candela
