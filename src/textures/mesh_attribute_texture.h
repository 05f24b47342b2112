#pragma once
// Colours that meshes bring along.

#include "textures/texture_kind.h"

namespace candela {

/// The colours of a mesh's vertices, interpolated over triangles, or of its faces. White on surfaces that
/// have none.
struct MeshAttributeTexture {
  enum class Attribute : int { vertex_color, face_color };

  static constexpr std::string_view kName = "mesh_attribute";
  static std::span<const Field<MeshAttributeTexture>> rows() {
    static constexpr std::string_view kAttributes[] = {"vertex_color", "face_color"};
    static const Field<MeshAttributeTexture> table[] = {
        {{"attribute", FieldType::choice, 0, 0, "", "Colours of the mesh's vertices or of its faces",
          Invalidates::image, kAttributes},
         [](MeshAttributeTexture& t) -> void* { return &t.attribute; }},
    };
    return table;
  }

  Attribute attribute = Attribute::vertex_color;
  bool operator==(const MeshAttributeTexture&) const = default;

  vec4 texel(const SurfacePlace& place) const {
    return vec4(attribute == Attribute::vertex_color ? place.vertex_color : place.face_color, 1);
  }
  vec3 color(const TextureUse& use, vec2) const { return texel_color(texel({}), use.channel); }
  float number(const TextureUse& use, vec2) const { return texel_number(texel({}), use.channel); }
  vec2 cells() const { return vec2(1); }
  std::size_t memory_bytes() const { return 0; }
};

} // namespace candela
