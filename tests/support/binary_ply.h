#pragma once
// Meshes of another renderer's tests.

#include "scene/mesh.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace candela::test {

/// Reads a little-endian PLY whose properties are floats, but for the faces' lists of three indices (uchar,
/// int). Colours of vertices and faces are color_0 to color_2; those of faces that have a weight_0 are that,
/// in grey.
inline Mesh read_binary_ply(const std::string& path, bool weights = false) {
  static_assert(std::endian::native == std::endian::little);
  std::ifstream file(path, std::ios::binary);
  std::map<std::string, std::vector<std::string>> properties; // by element
  std::map<std::string, std::size_t> counts;
  std::string line, element;
  while (std::getline(file, line) && line != "end_header") {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word;
    if (word == "element") {
      words >> element;
      words >> counts[element];
    } else if (word == "property") {
      words >> type;
      if (type == "list")
        words >> type >> type;
      else if (type != "float")
        throw std::runtime_error("property of PLY: " + line);
      words >> name;
      properties[element].push_back(name);
    }
  }
  auto value = [&](auto v) {
    char bytes[sizeof v];
    if (!file.read(bytes, sizeof v)) throw std::runtime_error(path + " ends early");
    std::memcpy(&v, bytes, sizeof v);
    return v;
  };
  Mesh mesh;
  for (std::size_t i = 0; i < counts["vertex"]; ++i) {
    std::map<std::string, float> p;
    for (const std::string& name : properties["vertex"]) p[name] = value(0.0f);
    mesh.positions.emplace_back(p["x"], p["y"], p["z"]);
    mesh.normals.emplace_back(p["nx"], p["ny"], p["nz"]);
    mesh.uvs.emplace_back(p["u"], p["v"]);
    mesh.vertex_colors.emplace_back(p["color_0"], p["color_1"], p["color_2"]);
  }
  for (std::size_t i = 0; i < counts["face"]; ++i) {
    uvec3 corners(0);
    std::map<std::string, float> p;
    for (const std::string& name : properties["face"])
      if (name != "vertex_indices" && name != "vertex_index")
        p[name] = value(0.0f);
      else if (value(std::uint8_t{}) != 3)
        throw std::runtime_error("polygons in " + path);
      else
        for (int c = 0; c < 3; ++c) corners[c] = value(std::uint32_t{});
    mesh.triangles.push_back(corners);
    mesh.face_colors.push_back(weights ? vec3(p["weight_0"])
                                       : vec3(p["color_0"], p["color_1"], p["color_2"]));
  }
  return mesh;
}

} // namespace candela::test
