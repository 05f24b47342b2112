#pragma once
// Bulk data of a scene: shared between copies of a Document and never changed once they are in one.

#include "core/bounds.h"
#include "core/math.h"

#include <string>
#include <vector>

namespace candela {

/// Triangles with one index per corner for all attributes; readers split vertices where attributes differ.
struct Mesh {
  std::string name;
  std::string
      source; ///< the file it came from, for messages and for writing it back by reference; may be empty
  /// In the file's coordinates: positions are relative to it, so that they keep their shape in floats however
  /// far they lie from the file's origin. Instances hold it in their transform.
  glm::dvec3 origin{0};
  std::vector<vec3> positions;
  std::vector<vec3>
      normals; ///< unit, per vertex; empty: flat. A zero normal means: flat at this vertex's triangles.
  std::vector<vec2> uvs; ///< per vertex; empty: none
  std::vector<uvec3> triangles;
  std::vector<std::uint32_t> material_slots;    ///< per triangle, indexes slot_names; empty: all 0
  std::vector<std::string> slot_names = {""};   ///< what the file calls its materials
  bool operator==(const Mesh&) const = default; ///< by value; compare pointers first where that is enough
};

/// An 8-bit sRGB picture that colours a surface; row 0 is the top, three bytes a texel.
struct Texture {
  std::string name;
  std::string source;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> srgb;
  bool operator==(const Texture&) const = default;
};

/// A float picture: linear Rec. 709, row 0 is the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<vec3> pixels;

  const vec3& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  vec3& at(int x, int y) { return const_cast<vec3&>(static_cast<const Image&>(*this).at(x, y)); }
  bool operator==(const Image&) const = default;
};

/// The radiance that comes from all around, as a picture; six faces of a cube are stacked in the order of
/// their files. Pixels are finite and not negative.
struct Panorama {
  std::string name;
  std::vector<std::string> sources; ///< the file, or those of the six faces; may be empty
  Image image;
  bool operator==(const Panorama&) const = default;
};

} // namespace candela
