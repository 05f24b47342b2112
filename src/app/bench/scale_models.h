#pragma once
// What the scenes of `candela bench scale` are made of: mountains and stones of as many triangles as are
// asked for, and the pictures that colour them. Pure functions: the same arguments give the same bytes.

#include "imaging/texels.h"
#include "scene/mesh.h"

namespace candela {

/// Height of the mountains over the point (x, z), scene units of about 100 m. A valley lies about the origin.
/// Without what is too fine for heights taken so far from each other.
double mountain_height(glm::dvec2 p, double spacing = 0);

/// Mountains, 34 units wide and 24 deep, finest where the valley opens, with boulders there; y is up. No
/// two triangles are the same; normals and uvs throughout; slots "ground" and "boulder". At least `triangles`
/// (>= 1000) of them, and hardly more.
Mesh mountain_mesh(std::size_t triangles);
/// For the ground: size^2 texels.
Texels mountain_texture(int size);

/// A stone of 12 cells^2 triangles about the origin, of a radius about 1, its edges worn.
Mesh stone_mesh(int cells, std::uint32_t seed);
/// For stones.
Texels stone_texture(int size);

} // namespace candela
