#pragma once
// The polygons of an OBJ file as a mesh of triangles.

#include "io/obj/obj_parser.h"
#include "scene/mesh.h"

namespace candela {

/// Makes one vertex of equal corners, and triangles of polygons. Drops faces whose vertices are nowhere and
/// triangles without area, and takes attributes that are nowhere for missing; all that is counted in
/// `warnings`. A mesh far from its origin is moved there (Mesh::origin). It is the part [share, 1] of
/// `progress`. Throws what was wrong where the first face was lost if none is left.
Mesh obj_mesh(const ObjContents& contents, const std::string& file, WarningList& warnings,
              ProgressPart& progress, double share);

/// Where a mesh of these bounds has its origin so that its shape survives in floats: 0 where it does anyway.
/// Each coordinate is a float.
glm::dvec3 mesh_origin(glm::dvec3 lower, glm::dvec3 upper);

} // namespace candela
