#pragma once
// Writing Wavefront OBJ files.

#include "scene/mesh.h"

#include <string>

namespace candela {

/// Writes positions (with the colours of vertices as screens show them, cut at 1), uvs and normals (seven
/// digits each) and the triangles, with a usemtl of the slot's name where that changes; `library` is the name
/// for mtllib, which is omitted if empty. Writes atomically; output_error if the file cannot be written.
void write_obj(const Mesh& mesh, const std::string& library, const std::string& path);

} // namespace candela
