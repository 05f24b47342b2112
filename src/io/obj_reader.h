#pragma once
// Wavefront OBJ with its MTL.

#include "io/mtl_reader.h"
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
/// triangulated (io/triangulate.h); degenerate triangles are dropped; lines, points, curves, vertex colours,
/// groups and smoothing groups are ignored. What is dropped or missing is counted in `warnings`.
///
/// Throws input_error with line and column for words that are no finite numbers, indices out of range and
/// files without a face; limit_error above 2 GiB or 4096 corners of a polygon.
ObjModel read_obj(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings);

} // namespace candela
