#pragma once
// The parameters of a scene's materials that use a texture.

#include "app/tools/texture_view_state.h"
#include "scene/scene_desc.h"

#include <string>
#include <vector>

namespace candela {

struct TextureUser {
  TextureTarget parameter;
  std::string label; ///< "Material 2: base color"
  ParameterLook look;
};

/// In the order of the materials and of their rows.
std::vector<TextureUser> texture_users(const SceneDesc& scene, int texture);

/// Its name, or "Texture 3".
std::string texture_label(const SceneDesc& scene, int texture);

/// What it is in words: "picture, 1024 x 512, 3 channels of 8 bits".
std::string texture_summary(const Texture& texture);

/// "1.5 MB".
std::string bytes_text(std::size_t bytes);

/// Ends of the edges of a mesh's triangles in texture coordinates, each edge once; empty of meshes without
/// coordinates.
struct UvEdge {
  vec2 from{0}, to{0};
};
std::vector<UvEdge> uv_layout(const Mesh& mesh, std::size_t most);

} // namespace candela
