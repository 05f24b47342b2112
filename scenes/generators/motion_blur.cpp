// Writes scenes/motion_blur.json: a propeller that spins, a ball that rolls and a flag that waves, each for
// as long as the shutter is open.
//
//   cmake --build --preset release --target scene_data

#include "core/math.h"
#include "json_rows.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <functional>
#include <vector>

namespace {

using candela::vec2;
using candela::vec3;

constexpr const char* kScene = R"({{
  "candela": 1,
  "description": "What moves while the shutter is open: a propeller by a fifth of a turn, a ball that rolls, a flag whose vertices move. Set camera.shutter_close to 0 for an instant and to 0.3 for a shorter exposure; change the angle and the axis in the propeller's Motion; the bookmark follows the ball. Written by scenes/generators/motion_blur.cpp.",

  "camera": {{"position": [0, 1.5, 6.4], "target": [0, 1.12, 0], "vertical_fov": 32, "shutter_close": 1}},
  "bookmarks": [
    {{"name": "follow the ball", "camera": {{"position": [0, 1.5, 6.4], "target": [0, 1.12, 0], "vertical_fov": 32, "shutter_close": 1,
      "motion_position": [0.7, 0, 0], "motion_target": [0.7, 0, 0]}}}}
  ],

  "textures": [
    {{"type": "checker", "name": "tiles", "even": 0.62, "odd": 0.36}},
    {{"type": "checker", "name": "patches", "even": [0.85, 0.16, 0.08], "odd": 0.85, "squares": 6}},
    {{"type": "checker", "name": "stripes", "even": [0.05, 0.17, 0.5], "odd": 0.85, "squares": 4}}
  ],

  "materials": [
    {{"name": "floor", "diffuse": {{"texture": "tiles", "uv_scale": [0.7, 0.7]}}}},
    {{"name": "wall", "diffuse": {{"texture": "tiles", "uv_scale": [0.5, 0.5], "factor": 0.8}}}},
    {{"name": "ball", "type": "plastic", "diffuse": {{"texture": "patches"}}, "roughness": 0.2}},
    {{"name": "cloth", "diffuse": {{"texture": "stripes"}}}},
    {{"name": "blades", "type": "plastic", "diffuse": [0.9, 0.55, 0.08], "roughness": 0.3}},
    {{"name": "steel", "type": "conductor", "metal": "Fe", "roughness": 0.25}},
    {{"name": "glass", "type": "dielectric"}},
    {{"name": "lamp", "diffuse": 0, "emission": [27, 25, 21]}}
  ],

  "lights": [{{"name": "room", "type": "constant", "color": [0.28, 0.31, 0.36]}}],

  "meshes": {{
    "propeller": {{
{}
    }},
    "flag": {{
{}
    }}
  }},

  "instances": [
    {{"name": "floor", "shape": "plane", "material": "floor", "transform": [{{"rotate": [1, 0, 0, -90]}}]}},
    {{"name": "wall", "shape": "plane", "material": "wall", "transform": [{{"translate": [0, 0, -1.6]}}]}},
    {{"name": "lamp", "shape": "rectangle", "material": "lamp",
     "transform": [{{"scale": 0.9}}, {{"look_at": {{"origin": [2.2, 4.4, 3], "target": [0, 0.6, 0], "up": [0, 1, 0]}}}}]}},
    {{"name": "propeller", "mesh": "propeller", "material": "blades",
     "transform": [{{"rotate": [0, 1, 0, 25]}}, {{"translate": [-1.25, 1.45, 0.12]}}], "motion": {{"axis": [0, 0, 1], "angle": 75}}}},
    {{"name": "hub", "shape": "cylinder", "radius": 0.1, "height": 0.3, "material": "steel",
     "transform": [{{"translate": [0, 0, -0.2]}}, {{"rotate": [0, 1, 0, 25]}}, {{"translate": [-1.25, 1.45, 0.12]}}]}},
    {{"name": "stand", "shape": "cylinder", "radius": 0.04, "height": 1.4, "material": "steel",
     "transform": [{{"rotate": [1, 0, 0, -90]}}, {{"translate": [-1.32, 0, 0.02]}}]}},
    {{"name": "ball", "shape": "sphere", "radius": 0.42, "material": "ball",
     "transform": [{{"rotate": [1, 0, 0, -60]}}, {{"translate": [-0.2, 0.42, 1.1]}}],
     "motion": {{"translate": [0.7, 0, 0], "axis": [0, -0.8660254, -0.5], "angle": {:.5f}}}}},
    {{"name": "still", "shape": "sphere", "radius": 0.3, "material": "glass", "transform": [{{"translate": [-1.1, 0.3, 1.2]}}]}},
    {{"name": "flag", "mesh": "flag", "material": "cloth", "transform": [{{"translate": [1, 1.35, 0]}}]}},
    {{"name": "pole", "shape": "cylinder", "radius": 0.03, "height": 2.3, "material": "steel",
     "transform": [{{"rotate": [1, 0, 0, -90]}}, {{"translate": [0.99, 0, 0]}}]}}
  ],

  "settings": {{"film": {{"width": 720, "height": 480}}, "stop": {{"spp": 256}}, "display": {{"tone_map": "filmic"}}}}
}}
)";

struct Grid {
  std::vector<vec3> begin, end;
  std::vector<vec2> uvs;
  std::vector<candela::uvec3> triangles;

  /// (columns + 1) x (rows + 1) vertices; `place` gives those of times 0 and 1, by (u, v) in [0, 1]^2.
  void add(unsigned columns, unsigned rows, const std::function<vec3(vec2, float)>& place) {
    const auto first = static_cast<unsigned>(begin.size());
    for (unsigned i = 0; i <= columns; ++i)
      for (unsigned j = 0; j <= rows; ++j) {
        const vec2 uv(static_cast<float>(i) / static_cast<float>(columns),
                      static_cast<float>(j) / static_cast<float>(rows));
        begin.push_back(place(uv, 0)), end.push_back(place(uv, 1));
        uvs.push_back(uv);
      }
    for (unsigned i = 0; i < columns; ++i)
      for (unsigned j = 0; j < rows; ++j) {
        const unsigned a = first + i * (rows + 1) + j, b = a + rows + 1;
        triangles.emplace_back(a, b, b + 1);
        triangles.emplace_back(a, b + 1, a + 1);
      }
  }

  static std::string list(const char* key, const std::vector<vec3>& points) {
    return json_rows(key, points, 4,
                     [](vec3 p) { return fmt::format("[{:.4f}, {:.4f}, {:.4f}]", p.x, p.y, p.z); });
  }
  std::string json(bool deforms) const {
    return list("positions", begin) + (deforms ? ",\n" + list("positions_end", end) : "") + ",\n" +
           json_rows("uvs", uvs, 8, [](vec2 uv) { return fmt::format("[{:.4g}, {:.4g}]", uv.x, uv.y); }) +
           ",\n" + json_rows("triangles", triangles, 8, [](candela::uvec3 t) {
             return fmt::format("[{}, {}, {}]", t.x, t.y, t.z);
           });
  }
};

/// Three blades about the z axis, twisted more towards their root.
Grid propeller() {
  Grid grid;
  for (int blade = 0; blade < 3; ++blade) {
    const float turn = 2 * candela::kPi * static_cast<float>(blade) / 3;
    grid.add(10, 2, [turn](vec2 uv, float) {
      const float radius = 0.08f + 0.92f * uv.x,
                  chord = 0.14f + 0.26f * std::sin(candela::kPi * (0.15f + 0.8f * uv.x)),
                  twist = candela::radians(55 - 40 * uv.x), s = (uv.y - 0.5f) * chord;
      const vec2 p(radius, s * std::cos(twist));
      return vec3(p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn),
                  s * std::sin(twist));
    });
  }
  return grid;
}

/// A wave that runs to the free end and grows towards it.
Grid flag() {
  Grid grid;
  grid.add(24, 8, [](vec2 uv, float time) {
    const float phase = 7 * uv.x + 1.2f * uv.y - 1.7f * time, swing = 0.2f * uv.x * (0.6f + 0.4f * uv.x);
    return vec3(1.15f * uv.x - 0.12f * uv.x * uv.x * std::cos(phase) * std::cos(phase),
                0.85f * uv.y - 0.1f * uv.x * uv.x + 0.05f * uv.x * std::sin(phase - 0.7f),
                swing * std::sin(phase));
  });
  return grid;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_motion_blur FILE.json\n");
    return 2;
  }
  // A ball that rolls turns by its way over its radius.
  const double angle = 0.7 / 0.42 * 180 / std::numbers::pi;
  auto out = fmt::output_file(argv[1]);
  out.print("{}", fmt::format(kScene, propeller().json(false), flag().json(true), angle));
}
