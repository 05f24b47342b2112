#pragma once
// Models of the scenes of `candela bench scale`: mountains and stones of a given number of triangles, and
// their textures. Pure functions: the same arguments give the same bytes.

#include "imaging/texels.h"
#include "scene/mesh.h"

namespace candela {

/// Height of the mountains over the point (x, z), scene units of about 100 m. A valley lies around the
/// origin. Details finer than `spacing` are left out.
double mountain_height(glm::dvec2 p, double spacing = 0);

/// Mountains, 34 units wide and 24 deep, finest where the valley opens, with boulders there; y is up. No
/// two triangles are the same; normals and uvs throughout; slots "ground" and "boulder". At least `triangles`
/// (>= 1000) of them, and hardly more.
Mesh mountain_mesh(std::size_t triangles);
/// Texture of the ground: size^2 texels.
Texels mountain_texture(int size);

/// A stone with worn edges, of 12 cells^2 triangles, with a radius of about 1 around the origin.
Mesh stone_mesh(int cells, std::uint32_t seed);
/// Texture of stones.
Texels stone_texture(int size);

} // namespace candela
