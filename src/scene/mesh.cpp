#include "scene/mesh.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

std::string topology_problem(const Mesh& begin, const Mesh& end) {
  if (begin.positions.size() != end.positions.size())
    return fmt::format("it has {} vertices, where the mesh at time 0 has {}", end.positions.size(),
                       begin.positions.size());
  if (begin.triangles.size() != end.triangles.size())
    return fmt::format("it has {} triangles, where the mesh at time 0 has {}", end.triangles.size(),
                       begin.triangles.size());
  const auto differ = std::ranges::mismatch(begin.triangles, end.triangles);
  if (differ.in1 != begin.triangles.end())
    return fmt::format("triangle {} has other vertices than that of the mesh at time 0",
                       differ.in1 - begin.triangles.begin());
  if (begin.normals.size() != end.normals.size())
    return begin.normals.empty() ? "it has normals, the mesh at time 0 has none"
                                 : "it has no normals, the mesh at time 0 has";
  return {};
}

Mesh deforming(Mesh begin, const Mesh& end) {
  const glm::dvec3 shift = end.origin - begin.origin; // both are relative to their own
  begin.positions_end.clear();
  for (const vec3 p : end.positions)
    begin.positions_end.push_back(shift == glm::dvec3(0) ? p : vec3(glm::dvec3(p) + shift));
  begin.normals_end = end.normals;
  begin.source_end = end.source;
  return begin;
}

} // namespace candela
