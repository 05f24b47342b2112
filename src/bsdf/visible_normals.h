#pragma once
// Quadrature over the facets that a direction sees, for tables.

#include "bsdf/microfacets.h"

namespace candela {

/// Calls visit(h) with `count` facet normals that w, above the surface, sees: in proportion to the facets'
/// projected areas, on a golden-ratio lattice.
template <class Visit>
void for_visible_normals(const Microfacets& facets, vec3 w, int count, Visit visit) {
  for (int i = 0; i < count; ++i) {
    const double x = (i + 0.5) / count, y = i * 0.61803398874989485;
    const vec2 u(static_cast<float>(x), static_cast<float>(y - std::floor(y)));
    visit(facets.sample_visible_normal(w, sample_uniform_disc(u)));
  }
}

} // namespace candela
