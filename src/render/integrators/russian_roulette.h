#pragma once

#include "scene/document.h"

namespace candela {

/// With what probability q a path continues (Arvo and Kirk 1990): continuing with probability q and weight
/// 1/q keeps the mean. q is the throughput over the threshold, within the bounds.
struct Roulette {
  float min_survival = 1;
  float threshold = kInfinity; ///< the throughput above which q is 1
  float max_survival = 1;      ///< whatever min_survival says: see survival_bound()

  /// For paths of `depth` segments.
  static Roulette at(const PathSettings& settings, int depth);
};

/// The highest probability with which a path of `depth` segments may continue, whatever it carries and
/// whatever the settings say: in rooms and glass that lose no light the throughput stays 1, and nothing else
/// ends a path.
float survival_bound(int depth);

} // namespace candela
