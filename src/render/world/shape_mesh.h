#pragma once
// The shapes that are rendered as triangles.

#include "scene/scene_desc.h"

namespace candela {

/// A shape as a mesh that many of its kind share, and where that mesh lies in the shape's space.
struct MeshedShape {
  Shape standard; ///< the shape that the mesh is of: shapes with equal ones share it
  mat4 shape_from_standard{1.0f};
};

/// Nothing for meshes, spheres, rectangles and discs, which are no triangles or no more than they are.
std::optional<MeshedShape> meshed_shape(const Shape& shape);

/// The mesh of such a standard shape: cubes, tori and what has caps are watertight; normals point outwards
/// and are exact at the vertices; uvs are in [0, 1]^2 but for the plane's.
///
/// Circles have 512 sides: one of radius r pixels is off by r (1 - cos(pi / 512)), 0.02 pixels where it fills
/// the height of a 4K picture, and less than one until it is 50 times as large. The torus's circle has 256,
/// the tube 128: 0.08 and at most 0.16 pixels off where the torus fills the picture. The plane ends 16384
/// units away, which is 0.1 milliradians below the horizon from 1.5 units above it, a fifth of a pixel of a
/// 4K picture of 60 degrees.
Mesh shape_mesh(const Shape& standard);

} // namespace candela
