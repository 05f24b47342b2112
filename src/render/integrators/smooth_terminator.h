#pragma once
// The shadow terminator of coarse smooth meshes.

#include "render/integrators/vertex_lanes.h"

namespace candela {

/// Shading by interpolated normals continues beyond the triangles that face the light, the shadow does not:
/// the triangles themselves occlude it, and coarse meshes show their facets where the light grazes them.
/// So a path leaves such a surface from the curved one that the vertices' normals describe (Hanika 2021,
/// "Hacking the Shadow Terminator", Ray Tracing Gems II, chapter 4), and the curved one's tangent plane tells
/// which directions are outside: shadow rays and continuation rays alike, so that light sampling and BSDF
/// sampling keep one expectation. The change falls with the square of the size of the triangles. It is none
/// for triangles that are flat, or concave on the viewer's side. Rays start on the viewer's side of their
/// triangle, and no farther from it than the curved surface, so that closed meshes leak no light.
///
/// Where a surface transmits, its rays leave on both sides of the triangle; it is left as it is.

/// Of each lane where hits[i] was met.
void smooth_terminator(VertexLanes& vertices, const Geometry& geometry, std::span<const Ray* const> rays,
                       std::span<const Hit> hits);
/// Of one vertex with this BSDF.
void smooth_terminator(Vertex& vertex, const Bsdf& bsdf, const Geometry& geometry, const Ray& ray,
                       const Hit& hit);

} // namespace candela
