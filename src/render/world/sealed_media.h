#pragma once
// Media that no light sample can reach.

#include "render/world/scene_parts.h"
#include "scene/mesh.h"

#include <map>
#include <memory>

namespace candela {

/// What is known of a mesh, for it takes a while to find out.
struct MeshHull {
  bool closed; ///< every edge is shared by triangles of either direction
  Bounds3 bounds;
};
using MeshHulls = std::map<std::shared_ptr<const Mesh>, MeshHull>;

MeshHull hull_of(const Mesh& mesh);

/// By the index of the medium: whether all bodies of it are closed by surfaces that refract or scatter all
/// light, with no light inside, as milk in a glass or skin. From points in them every shadow ray ends at the
/// surface, so lights need not be sampled. Where it is not certain, they are not sealed. `hulls` become those
/// of the meshes around media; those that they hold serve again.
std::vector<bool> sealed_media(const std::vector<Instance>& instances, const SceneMaterials& materials,
                               const std::vector<Light>& lights, MeshHulls& hulls);

} // namespace candela
