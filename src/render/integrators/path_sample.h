#pragma once
// What one camera path brings back.

#include "core/color.h"
#include "core/spectrum.h"

namespace candela {

/// Radiance in W/(m^2 sr), kept apart by the length of the path that found it ("event splitting": direct and
/// indirect light are accumulated apart at every step), and once more for what light sampling found.
struct PathSample {
  Spectrum emitted{0};       ///< by emitters seen directly (1 segment)
  Spectrum direct{0};        ///< 2 segments
  Spectrum one_bounce{0};    ///< 3 segments
  Spectrum more{0};          ///< 4 and more
  Spectrum light_sampled{0}; ///< of direct, one_bounce and more: by light sampling rather than BSDF sampling

  Spectrum indirect() const { return one_bounce + more; }
  Spectrum radiance() const { return (emitted + direct) + (one_bounce + more); }

  void add(Spectrum contribution, int depth) {
    (depth <= 1 ? emitted : depth == 2 ? direct : depth == 3 ? one_bounce : more) += contribution;
  }
  void add_light_sampled(Spectrum contribution, int depth) {
    add(contribution, depth);
    light_sampled += contribution;
  }
  PathSample& operator*=(float weight) {
    for (Spectrum* part : {&emitted, &direct, &one_bounce, &more, &light_sampled}) *part *= weight;
    return *this;
  }
};

} // namespace candela
