#include "render/integrators/path_length.h"

#include <algorithm>
#include <limits>

namespace candela {

bool shows_depth(const PathSettings& settings, int depth) {
  if (settings.only_depth > 0 && depth != settings.only_depth) return false;
  switch (settings.component) {
  case PathComponent::all: return true;
  case PathComponent::emitted: return depth == 1;
  case PathComponent::direct: return depth == 2;
  case PathComponent::indirect: return depth > 2;
  }
  return true;
}

int longest_path(const PathSettings& settings) {
  int last = settings.max_depth;
  if (last < 0)
    last =
        settings.rr == RussianRoulette::off ? kMostSegmentsWithoutRoulette : std::numeric_limits<int>::max();
  if (settings.only_depth > 0) last = std::min(last, settings.only_depth);
  if (settings.component == PathComponent::emitted) last = std::min(last, 1);
  if (settings.component == PathComponent::direct) last = std::min(last, 2);
  return last;
}

} // namespace candela
