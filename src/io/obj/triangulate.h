#pragma once
// Polygons into triangles.

#include "core/math.h"

#include <array>
#include <span>
#include <vector>

namespace candela {

/// Splits a simple polygon, given by its corners in order, into corners.size() - 2 triangles of indices into
/// `corners`, with its orientation. Convex or not; not quite planar ones are judged in the plane of their
/// area vector. Quadrilaterals are cut along 0-2 unless only 1-3 is inside. Ear clipping, O(n^2) (Meisters
/// 1975, "Polygons have ears"). A polygon that crosses itself gives as many triangles, some of them wrong.
void triangulate(std::span<const vec3> corners, std::vector<std::array<int, 3>>& triangles);

} // namespace candela
