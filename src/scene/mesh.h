#pragma once
// Bulk data of a scene: shared between copies of a Document, and immutable once in one.

#include "core/bounds.h"
#include "core/math.h"

#include <string>
#include <vector>

namespace candela {

/// Triangles with one index per corner for all attributes; readers split vertices with different attributes.
struct Mesh {
  std::string name;
  std::string
      source; ///< the file it came from, for messages and for writing it back by reference; may be empty
  /// In the file's coordinates. Positions are relative to it, so that floats are precise enough far from the
  /// file's origin. Instances include it in their transform.
  glm::dvec3 origin{0};
  std::vector<vec3> positions;
  std::vector<vec3>
      normals; ///< unit, per vertex; empty: flat. A zero normal means: flat at this vertex's triangles.
  /// Of a mesh that deforms: positions and normals at time 1, as many as above; positions that are empty: it
  /// keeps its shape. Values between are linear in time.
  std::vector<vec3> positions_end, normals_end;
  std::string source_end;          ///< the file that those came from; may be empty
  std::vector<vec2> uvs;           ///< per vertex; empty: none
  std::vector<vec3> vertex_colors; ///< linear Rec. 709, at least 0, per vertex; empty: none
  std::vector<uvec3> triangles;
  std::vector<vec3> face_colors;                ///< likewise, per triangle; empty: none
  std::vector<std::uint32_t> material_slots;    ///< per triangle, indexes slot_names; empty: all 0
  std::vector<std::string> slot_names = {""};   ///< what the file calls its materials
  bool operator==(const Mesh&) const = default; ///< by value; compare pointers first where that is enough

  bool deforms() const { return !positions_end.empty(); }
};

/// Why `end` cannot be what `begin` deforms to; empty if it can.
std::string topology_problem(const Mesh& begin, const Mesh& end);
/// `begin` with the vertices of `end` at time 1.
Mesh deforming(Mesh begin, const Mesh& end);

} // namespace candela
