#pragma once
// What one camera path brings back.

#include "core/color.h"
#include "core/math.h"

namespace candela {

/// Radiance in W/(m^2 sr), kept apart by the length of the path that found it ("event splitting": direct and
/// indirect light are accumulated apart at every step), and once more for what aiming at lights found.
struct PathSample {
  vec3 emitted{0};    ///< by emitters seen directly (1 segment)
  vec3 direct{0};     ///< 2 segments
  vec3 one_bounce{0}; ///< 3 segments
  vec3 more{0};       ///< 4 and more
  vec3 aimed{0};      ///< of direct, one_bounce and more: by light sampling rather than by chance

  vec3 indirect() const { return one_bounce + more; }
  vec3 radiance() const { return (emitted + direct) + (one_bounce + more); }

  void add(vec3 contribution, int depth) {
    (depth <= 1 ? emitted : depth == 2 ? direct : depth == 3 ? one_bounce : more) += contribution;
  }
  void add_aimed(vec3 contribution, int depth) {
    add(contribution, depth);
    aimed += contribution;
  }
  PathSample& operator*=(float weight) {
    for (vec3* part : {&emitted, &direct, &one_bounce, &more, &aimed}) *part *= weight;
    return *this;
  }
};

} // namespace candela
