#pragma once
// Wavefront OBJ, as modelling programs write it.

#include "scene/mesh.h"

#include <string>

namespace candela {

/// Writes positions, uvs and normals (seven digits each) and the triangles, with a usemtl of the slot's name
/// where that changes; `library` is what mtllib names, nothing if empty. The file appears whole or not at
/// all; output_error if it cannot be written.
void write_obj(const Mesh& mesh, const std::string& library, const std::string& path);

} // namespace candela
