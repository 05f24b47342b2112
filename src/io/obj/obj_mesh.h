#pragma once
// Converts the polygons of an OBJ file to a triangle mesh.

#include "io/obj/obj_parser.h"
#include "scene/mesh.h"

namespace candela {

/// Merges equal corners to vertices and triangulates polygons. Drops faces with invalid vertices and
/// triangles without area, and treats invalid attributes as missing; all are counted in `warnings`. A mesh
/// far from its origin is moved there (Mesh::origin). The work is the part [share, 1] of `progress`. If no
/// face is left, throws the error of the first lost one.
Mesh obj_mesh(const ObjContents& contents, const std::string& file, WarningList& warnings,
              ProgressPart& progress, double share);

/// The origin for a mesh of these bounds such that floats represent its shape: 0 if they do already. Each
/// coordinate is a float.
glm::dvec3 mesh_origin(glm::dvec3 lower, glm::dvec3 upper);

} // namespace candela
