// Writes scenes/coarse_meshes.json: a ball and a ring of few triangles, with the normals of the surfaces that
// they stand for.
//
//   cmake --build --preset release --target scene_data

#include "core/math.h"
#include "json_rows.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <functional>
#include <vector>

namespace {

using candela::kPi;
using candela::vec2;
using candela::vec3;

constexpr const char* kScene = R"({{
  "candela": 1,
  "description": "Meshes of few triangles under a low sun. Their normals are those of a ball and of a ring, but light grazes the triangles themselves: where it ends there are facets. Turn path.smooth_terminator off to see them; view = geometric_normal shows the triangles. Written by scenes/generators/coarse_meshes.cpp.",

  "camera": {{"position": [0, 1.6, 5.2], "target": [0.05, 0.72, 0], "vertical_fov": 27}},

  "materials": [
    {{"name": "floor", "diffuse": [0.32, 0.34, 0.36]}},
    {{"name": "clay", "diffuse": [0.72, 0.48, 0.36]}},
    {{"name": "plaster", "diffuse": 0.75}}
  ],

  "lights": [
    {{"name": "sun", "type": "directional", "direction": [0.92, -0.35, -0.25], "color": [3.2, 2.9, 2.5]}},
    {{"name": "sky", "type": "constant", "color": [0.1, 0.13, 0.17]}}
  ],

  "meshes": {{
    "ball": {{
{}
    }},
    "ring": {{
{}
    }}
  }},

  "instances": [
    {{"name": "floor", "shape": "plane", "material": "floor", "transform": [{{"rotate": [1, 0, 0, -90]}}]}},
    {{"name": "ball", "mesh": "ball", "material": "plaster", "transform": [{{"scale": 0.75}}, {{"translate": [-0.85, 0.75, 0]}}]}},
    {{"name": "ring", "mesh": "ring", "material": "clay",
     "transform": [{{"rotate": [1, 0, 0, 68]}}, {{"rotate": [0, 1, 0, 24]}}, {{"translate": [0.95, 0.8, 0]}}]}}
  ],

  "settings": {{"film": {{"width": 720, "height": 480}}, "stop": {{"spp": 128}}, "path": {{"smooth_terminator": true}}}}
}}
)";

/// A closed surface over [0, 1]^2.
struct Surface {
  std::vector<vec3> positions, normals;
  std::vector<candela::uvec3> triangles;

  struct Point {
    vec3 position, normal;
  };
  Surface(unsigned columns, unsigned rows, const std::function<Point(vec2)>& place) {
    for (unsigned i = 0; i <= columns; ++i)
      for (unsigned j = 0; j <= rows; ++j) {
        const Point p = place(vec2(i, j) / vec2(columns, rows));
        positions.push_back(p.position), normals.push_back(p.normal);
      }
    for (unsigned i = 0; i < columns; ++i)
      for (unsigned j = 0; j < rows; ++j) {
        const unsigned a = i * (rows + 1) + j, b = a + rows + 1;
        add(a, b, b + 1);
        add(a, b + 1, a + 1);
      }
  }
  /// But for those that a pole makes nothing of.
  void add(unsigned a, unsigned b, unsigned c) {
    const vec3 n = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    if (glm::length(n) > 1e-6f) triangles.emplace_back(a, b, c);
  }

  static std::string list(const char* key, const std::vector<vec3>& values) {
    return json_rows(key, values, 4,
                     [](vec3 v) { return fmt::format("[{:.5f}, {:.5f}, {:.5f}]", v.x, v.y, v.z); });
  }
  std::string json() const {
    return list("positions", positions) + ",\n" + list("normals", normals) + ",\n" +
           json_rows("triangles", triangles, 8,
                     [](candela::uvec3 t) { return fmt::format("[{}, {}, {}]", t.x, t.y, t.z); });
  }
};

Surface ball() {
  return {12, 8, [](vec2 uv) {
            const float phi = 2 * kPi * uv.x, theta = kPi * uv.y;
            const vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            return Surface::Point{n, n};
          }};
}

/// About the y axis.
Surface ring() {
  return {16, 8, [](vec2 uv) {
            constexpr float kRadius = 0.58f, kThick = 0.24f;
            const float phi = 2 * kPi * uv.x, theta = 2 * kPi * uv.y;
            const vec3 out(std::sin(phi), 0, std::cos(phi));
            const vec3 n = std::sin(theta) * out + vec3(0, std::cos(theta), 0);
            return Surface::Point{kRadius * out + kThick * n, n};
          }};
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_coarse_meshes FILE.json\n");
    return 2;
  }
  fmt::output_file(argv[1]).print(kScene, ball().json(), ring().json());
}
