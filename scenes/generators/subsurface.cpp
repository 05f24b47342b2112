// Writes scenes/subsurface.json: hands against the light and blobs, once by each method of the material
// `subsurface`. Both are spheres whose points move along their radii.
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
using candela::radians;
using candela::vec2;
using candela::vec3;

constexpr const char* kScene = R"({{
  "candela": 1,
  "description": "Hands against a lamp and blobs of the same matter, which scatters light inside: from left to right by a random walk, by Burley's profile and by the dipole. Where a body is thin red light comes through it. The profiles take every place for flat and endless, the walk knows the shape. Change method of a material; scale = 0.1, 1, 4; path.max_depth = 2, 16, 512 for the walk. Written by scenes/generators/subsurface.cpp.",

  "camera": {{"position": [0, 1.7, 8.4], "target": [0, 1.42, 0], "vertical_fov": 28}},

  "materials": [
    {{"name": "walk", "type": "subsurface", "color": [0.83, 0.57, 0.44], "radius": [0.1, 0.04, 0.025], "roughness": 0.75, "method": "random_walk"}},
    {{"name": "burley", "type": "subsurface", "color": [0.83, 0.57, 0.44], "radius": [0.1, 0.04, 0.025], "roughness": 0.75, "method": "burley"}},
    {{"name": "dipole", "type": "subsurface", "color": [0.83, 0.57, 0.44], "radius": [0.1, 0.04, 0.025], "roughness": 0.75, "method": "dipole"}},
    {{"name": "floor", "diffuse": [0.2, 0.21, 0.23]}},
    {{"name": "lamp", "diffuse": 0, "emission": [34, 32, 29]}},
    {{"name": "key", "diffuse": 0, "emission": [7, 7.5, 8]}}
  ],

  "lights": [{{"name": "room", "type": "constant", "color": [0.05, 0.055, 0.065]}}],

  "meshes": {{
    "hand": {{
{}
    }},
    "blob": {{
{}
    }}
  }},

  "instances": [
    {{"name": "hand, walk", "mesh": "hand", "material": "walk", "transform": [{{"translate": [-2.05, 2, -0.4]}}]}},
    {{"name": "hand, burley", "mesh": "hand", "material": "burley", "transform": [{{"translate": [0, 2, -0.4]}}]}},
    {{"name": "hand, dipole", "mesh": "hand", "material": "dipole", "transform": [{{"translate": [2.05, 2, -0.4]}}]}},
    {{"name": "blob, walk", "mesh": "blob", "material": "walk", "transform": [{{"translate": [-2.05, 0.5, 0.9]}}]}},
    {{"name": "blob, burley", "mesh": "blob", "material": "burley", "transform": [{{"translate": [0, 0.5, 0.9]}}]}},
    {{"name": "blob, dipole", "mesh": "blob", "material": "dipole", "transform": [{{"translate": [2.05, 0.5, 0.9]}}]}},
    {{"name": "floor", "shape": "plane", "material": "floor", "transform": [{{"rotate": [1, 0, 0, -90]}}]}},
    {{"name": "lamp", "shape": "rectangle", "material": "lamp",
     "transform": [{{"scale": [3.4, 0.4, 1]}}, {{"look_at": {{"origin": [0, 5.2, -3.2], "target": [0, 2, -0.4], "up": [0, 1, 0]}}}}]}},
    {{"name": "key", "shape": "rectangle", "material": "key",
     "transform": [{{"scale": 0.9}}, {{"look_at": {{"origin": [-5, 4, 5], "target": [0, 0.6, 0], "up": [0, 1, 0]}}}}]}}
  ],

  "settings": {{"film": {{"width": 720, "height": 420}}, "stop": {{"spp": 512}}, "path": {{"max_depth": 512}}, "display": {{"tone_map": "filmic"}}}}
}}
)";

/// A closed surface about the origin: place(uv) is a sphere moved, with u around its axis and v from pole to
/// pole.
struct Body {
  std::vector<vec3> positions, normals;
  std::vector<candela::uvec3> triangles;

  Body(unsigned columns, unsigned rows, const std::function<vec3(vec2)>& place) {
    constexpr float kStep = 1e-3f;
    auto add_vertex = [&](vec2 uv) {
      positions.push_back(place(uv));
      // At a pole all directions around are one point.
      uv.y = std::min(std::max(uv.y, 2 * kStep), 1 - 2 * kStep);
      const vec3 around = place(uv + vec2(kStep, 0)) - place(uv - vec2(kStep, 0)),
                 down = place(uv + vec2(0, kStep)) - place(uv - vec2(0, kStep));
      normals.push_back(glm::normalize(glm::cross(down, around)));
    };
    add_vertex({0, 0});
    for (unsigned j = 1; j < rows; ++j)
      for (unsigned i = 0; i < columns; ++i) add_vertex(vec2(i, j) / vec2(columns, rows));
    add_vertex({0, 1});
    const auto last = static_cast<unsigned>(positions.size() - 1);
    auto at = [&](unsigned i, unsigned j) { return 1 + (j - 1) * columns + i % columns; };
    for (unsigned i = 0; i < columns; ++i) {
      triangles.emplace_back(0u, at(i, 1), at(i + 1, 1));
      for (unsigned j = 1; j + 1 < rows; ++j) {
        triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
        triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
      }
      triangles.emplace_back(at(i, rows - 1), last, at(i + 1, rows - 1));
    }
  }

  static std::string list(const char* key, const std::vector<vec3>& values) {
    return json_rows(key, values, 6,
                     [](vec3 v) { return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", v.x, v.y, v.z); });
  }
  std::string json() const {
    return list("positions", positions) + ",\n" + list("normals", normals) + ",\n" +
           json_rows("triangles", triangles, 10,
                     [](candela::uvec3 t) { return fmt::format("[{}, {}, {}]", t.x, t.y, t.z); });
  }
};

/// A flat one in the xy plane, whose fingers are lobes of the radius over the angle from +y. More columns lie
/// where the fingers are.
Body hand() {
  struct Lobe {
    float angle, width, length; ///< degrees, degrees, scene units
  };
  constexpr Lobe kLobes[] = {{-34, 8.5f, 0.5f}, {-12, 8.5f, 0.72f}, {9, 8.5f, 0.76f},
                             {30, 8.5f, 0.6f},  {72, 12, 0.36f},    {180, 24, 0.45f}};
  return {96, 8, [&](vec2 uv) {
            constexpr float kFingers = 0.8f, kFirst = -52, kLast = 92;
            const float u = uv.x - std::floor(uv.x);
            const float angle = u < kFingers
                                    ? kFirst + (kLast - kFirst) * u / kFingers
                                    : kLast + (360 + kFirst - kLast) * (u - kFingers) / (1 - kFingers);
            float radius = 0.42f;
            for (const Lobe& lobe : kLobes) {
              float from = angle - lobe.angle;
              from -= 360 * std::round(from / 360);
              radius += lobe.length * std::exp(-candela::sqr(candela::sqr(from / lobe.width)));
            }
            const float phi = radians(angle), theta = kPi * uv.y;
            const float out = radius * std::sin(theta);
            return vec3(-out * std::sin(phi), out * std::cos(phi), 0.085f * std::cos(theta));
          }};
}

/// With two ears, a nose and feet, about the y axis.
Body blob() {
  struct Bump {
    vec3 direction;
    float sharpness, height;
  };
  const Bump kBumps[] = {{{0.42f, 1, -0.1f}, 26, 0.5f},
                         {{-0.42f, 1, -0.1f}, 26, 0.5f},
                         {{0, 0.1f, 1}, 30, 0.16f},
                         {{0.5f, -0.75f, 0.55f}, 14, 0.16f},
                         {{-0.5f, -0.75f, 0.55f}, 14, 0.16f}};
  return {40, 26, [&](vec2 uv) {
            const float phi = 2 * kPi * uv.x, theta = kPi * uv.y;
            const vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            float radius = 0.46f;
            for (const Bump& b : kBumps)
              radius += b.height * std::exp(b.sharpness * (glm::dot(n, glm::normalize(b.direction)) - 1));
            return radius * n;
          }};
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_subsurface FILE.json\n");
    return 2;
  }
  fmt::output_file(argv[1]).print(kScene, hand().json(), blob().json());
}
