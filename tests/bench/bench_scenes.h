#pragma once
// Scenes of traversal_bench: generated ones with few and with many triangles, and a scanned mesh.

#include "core/bounds.h"
#include "core/hash.h"
#include "core/math.h"

#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace candela::bench {

struct TriangleMesh {
  std::vector<vec3> vertices;
  std::vector<uvec3> triangles;
};

struct View {
  vec3 eye, target;
  float fov_y;
  vec3 light; ///< shadow rays go to a square around it
  float light_size;
};

struct BenchScene {
  std::string name;
  TriangleMesh mesh;
  View view;
};

inline void add_quad(TriangleMesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d) {
  auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A block of the Cornell box: four corners of the top and its height.
inline void add_block(TriangleMesh& mesh, std::array<vec2, 4> corner, float height) {
  auto at = [&](std::size_t i, float y) { return vec3(corner[i % 4].x, y, corner[i % 4].y); };
  add_quad(mesh, at(0, height), at(1, height), at(2, height), at(3, height));
  for (std::size_t i = 0; i < 4; ++i)
    add_quad(mesh, at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height));
}

/// The box as measured at Cornell (Goral et al. 1984): walls, light, two blocks without bottoms, 36 triangles
/// with the blocks' bottoms.
inline BenchScene cornell_box() {
  BenchScene scene{"cornell", {}, {{278, 273, -800}, {278, 273, 0}, radians(38), {278, 547, 280}, 130}};
  TriangleMesh& m = scene.mesh;
  add_quad(m, {552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f});
  add_quad(m, {556, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, 548.8f, 559.2f}, {0, 548.8f, 0});
  add_quad(m, {549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f});
  add_quad(m, {0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f});
  add_quad(m, {552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0});
  add_quad(m, {343, 548.7f, 227}, {343, 548.7f, 332}, {213, 548.7f, 332}, {213, 548.7f, 227});
  std::array<vec2, 4> low{{{130, 65}, {82, 225}, {240, 272}, {290, 114}}};
  std::array<vec2, 4> tall{{{423, 247}, {265, 296}, {314, 456}, {472, 406}}};
  add_block(m, low, 165), add_block(m, tall, 330);
  add_quad(m, {130, 0, 65}, {82, 0, 225}, {240, 0, 272}, {290, 0, 114});
  add_quad(m, {423, 0, 247}, {265, 0, 296}, {314, 0, 456}, {472, 0, 406});
  return scene;
}

/// A sphere of rings x 2 rings quads with bumps of three scales.
inline BenchScene displaced_sphere(std::uint32_t rings) {
  BenchScene scene{"sphere", {}, {{0, 0.5f, -3.2f}, {0, 0, 0}, radians(40), {2, 4, -3}, 1}};
  TriangleMesh& m = scene.mesh;
  std::uint32_t sectors = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(sectors);
      vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      float bump = 0.1f * std::sin(7 * d.x) * std::sin(8 * d.y) * std::sin(9 * d.z) +
                   0.02f * std::sin(41 * d.x) * std::sin(37 * d.y) * std::sin(43 * d.z) +
                   0.004f * std::sin(211 * d.x) * std::sin(223 * d.y) * std::sin(199 * d.z);
      m.vertices.push_back(d * (1 + bump));
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      std::uint32_t a = i * sectors + j, b = i * sectors + (j + 1) % sectors;
      m.triangles.push_back({a, b, b + sectors});
      m.triangles.push_back({a, b + sectors, a + sectors});
    }
  return scene;
}

/// Long thin triangles in all directions, which boxes fit badly.
inline BenchScene needles(std::uint32_t count) {
  BenchScene scene{"needles", {}, {{0, 0.3f, -2.6f}, {0, 0, 0}, radians(40), {1, 3, -2}, 1}};
  TriangleMesh& m = scene.mesh;
  auto random = [n = 0u]() mutable { return 2 * to_unit_float(hash32(++n)) - 1; };
  auto random_vec = [&] {
    float x = random(), y = random();
    return vec3(x, y, random());
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    vec3 c = 0.8f * random_vec(), along = 0.15f * random_vec(), across = 0.004f * random_vec();
    auto first = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {c - along, c + along, c + along + across});
    m.triangles.push_back({first, first + 1, first + 2});
  }
  return scene;
}

/// Positions and triangles of an OBJ file; empty if there is no such file.
inline TriangleMesh read_obj(const std::string& path) {
  TriangleMesh mesh;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    std::string tag;
    in >> tag;
    if (tag == "v") {
      vec3 p;
      in >> p.x >> p.y >> p.z;
      mesh.vertices.push_back(p);
    } else if (tag == "f") {
      std::vector<std::uint32_t> corners;
      for (std::string corner; in >> corner;)
        corners.push_back(static_cast<std::uint32_t>(std::stoul(corner)) - 1);
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return mesh;
}

inline BenchScene bunny() {
  BenchScene scene{"bunny", read_obj(std::string(CANDELA_SHARED_DATA) + "/meshes/stanford-bunny.obj"), {}};
  Bounds3 b;
  for (vec3 p : scene.mesh.vertices) b.grow(p);
  if (b.empty()) return scene;
  vec3 c = b.center();
  float size = max_component(b.diagonal());
  // The mesh is on a floor, as in typical scenes.
  float y = b.lo.y, s = 2 * size;
  add_quad(scene.mesh, {c.x - s, y, c.z - s}, {c.x - s, y, c.z + s}, {c.x + s, y, c.z + s},
           {c.x + s, y, c.z - s});
  scene.view = {c + size * vec3(0.3f, 0.5f, 1.5f), c, radians(42), c + size * vec3(1, 2, 1), 0.4f * size};
  return scene;
}

} // namespace candela::bench
