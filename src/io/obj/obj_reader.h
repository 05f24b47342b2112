#pragma once
// Wavefront OBJ with its MTL.

#include "io/obj/mtl_reader.h"
#include "scene/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace candela {

struct ObjModel {
  Mesh mesh; ///< name: the file's without folder and ending; source: the canonical path
  std::vector<std::optional<MtlMaterial>>
      materials; ///< by slot of the mesh; empty if no MTL has the material
};

/// Reads an OBJ file as one mesh with a slot for each material name that faces use ("" before the first
/// usemtl). Vertices are one per (v, vt, vn); a corner without vn is flat (zero normal), without vt it has uv
/// (0, 0). Indices may be negative (relative) and may refer to later vertices. Polygons are triangulated
/// (io/obj/triangulate.h); degenerate triangles are dropped; lines, points, curves, groups and smoothing
/// groups are ignored. Colours behind positions are sRGB. Positions are read in double precision, and
/// relative to an origin of the mesh's own where it lies far from the file's (Mesh::origin). Invalid numbers
/// and indices only affect their own vertex, attribute or face. If no library is found, the one with the
/// file's name is used. Everything dropped, missing or guessed is counted in `warnings`.
///
/// Throws input_error, located at the first loss, if no face is left; limit_error above 2 GiB, 4096 corners
/// of a polygon or 16 MiB of a line; Cancelled.
ObjModel read_obj(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings);

} // namespace candela
