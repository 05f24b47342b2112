#pragma once
// Triangulation of polygons.

#include "core/math.h"

#include <array>
#include <span>
#include <vector>

namespace candela {

/// Splits a simple polygon, given by its corners in order, into corners.size() - 2 triangles of indices into
/// `corners`, with its orientation. The polygon may be concave; slightly non-planar ones are projected along
/// their area vector. Quadrilaterals are cut along 0-2 unless only 1-3 is inside. Ear clipping, O(n^2)
/// (Meisters 1975, "Polygons have ears"). A self-intersecting polygon gives the same number of triangles,
/// some of them wrong.
void triangulate(std::span<const vec3> corners, std::vector<std::array<int, 3>>& triangles);

} // namespace candela
