#include "render/integrators/russian_roulette.h"

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
  const float max_survival = survival_bound(depth);
  if (depth < settings.rr_depth) return {1, kInfinity, max_survival};
  if (settings.rr == RussianRoulette::fixed) return {settings.rr_probability, kInfinity, max_survival};
  return {0, settings.rr_threshold, max_survival};
}

} // namespace candela
