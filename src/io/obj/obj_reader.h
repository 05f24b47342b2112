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
  std::vector<std::optional<MtlMaterial>> materials; ///< by slot of the mesh; nothing where no MTL has it
};

/// Reads an OBJ file as one mesh with a slot for each material name that faces use ("" before the first
/// usemtl). Vertices are one per (v, vt, vn); a corner without vn is flat (zero normal), without vt it has
/// uv (0, 0). Indices may be negative (relative) and may run ahead of the vertices they mean. Polygons are
/// triangulated (io/obj/triangulate.h); degenerate triangles are dropped; lines, points, curves, vertex
/// colours, groups and smoothing groups are ignored. Positions are read in double precision, and relative to
/// an origin of the mesh's own where it lies far from the file's (Mesh::origin). What is no number or means
/// nothing costs its own vertex, attribute or face. Where no library is found, that of the file's own name is
/// taken. What is dropped, missing or guessed is counted in `warnings`.
///
/// Throws input_error, with the place of the first loss, if no face is left; limit_error above 2 GiB, 4096
/// corners of a polygon or 16 MiB of a line; Cancelled.
ObjModel read_obj(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings);

} // namespace candela
