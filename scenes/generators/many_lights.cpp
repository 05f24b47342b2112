// Writes scenes/many_lights.json: a hall under strings of paper lanterns, cubes of twelve bright triangles
// each.
//
//   cmake --build --preset release --target scene_data

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>

namespace {

constexpr int kStrings = 30, kLanterns = 28; ///< 840 lanterns, 10080 triangles
constexpr double kHalfWidth = 6, kLength = 36;
constexpr const char* kColors[] = {"amber", "rose", "jade", "azure", "violet", "ivory"};

constexpr const char* kHead = R"({
  "candela": 1,
  "description": "A hall under 840 paper lanterns: 10,080 triangles shine, most of them too far away, hidden or turned away to matter to any one point. With path.light_choice = power a shadow ray goes to any of them; with contribution it goes down a tree to those that are near, bright and facing. Compare the two at equal time. Written by scenes/generators/many_lights.cpp.",

  "camera": {"position": [0.8, 2.1, 15.5], "target": [-0.6, 2.0, 0], "vertical_fov": 52},

  "materials": [
    {"name": "floor", "type": "ggx", "specular": [0.42, 0.36, 0.3], "roughness": 0.35},
    {"name": "plaster", "diffuse": [0.62, 0.58, 0.52]},
    {"name": "wood", "diffuse": [0.3, 0.17, 0.09]},
    {"name": "column", "diffuse": [0.55, 0.2, 0.14]},
    {"name": "glaze", "type": "phong", "diffuse": [0.1, 0.25, 0.3], "specular": [0.35, 0.35, 0.35], "exponent": 200},
    {"name": "amber", "diffuse": 0.5, "emission": [14, 6.5, 1.6]},
    {"name": "rose", "diffuse": 0.5, "emission": [13, 3, 4]},
    {"name": "jade", "diffuse": 0.5, "emission": [2.5, 9, 4]},
    {"name": "azure", "diffuse": 0.5, "emission": [2, 5, 13]},
    {"name": "violet", "diffuse": 0.5, "emission": [7, 2.5, 12]},
    {"name": "ivory", "diffuse": 0.5, "emission": [10, 8.5, 6]}
  ],

  "instances": [
    {"name": "floor", "shape": "rectangle", "material": "floor",
     "transform": [{"scale": [6, 18, 1]}, {"rotate": [1, 0, 0, -90]}]},
    {"name": "ceiling", "shape": "rectangle", "material": "wood",
     "transform": [{"scale": [6, 18, 1]}, {"rotate": [1, 0, 0, 90]}, {"translate": [0, 5.5, 0]}]},
    {"name": "left wall", "shape": "rectangle", "material": "plaster",
     "transform": [{"scale": [18, 2.75, 1]}, {"rotate": [0, 1, 0, 90]}, {"translate": [-6, 2.75, 0]}]},
    {"name": "right wall", "shape": "rectangle", "material": "plaster",
     "transform": [{"scale": [18, 2.75, 1]}, {"rotate": [0, 1, 0, -90]}, {"translate": [6, 2.75, 0]}]},
    {"name": "front wall", "shape": "rectangle", "material": "plaster",
     "transform": [{"scale": [6, 2.75, 1]}, {"rotate": [0, 1, 0, 180]}, {"translate": [0, 2.75, 18]}]},
    {"name": "back wall", "shape": "rectangle", "material": "plaster",
     "transform": [{"scale": [6, 2.75, 1]}, {"translate": [0, 2.75, -18]}]})";

constexpr const char* kTail = R"(
  ],

  "settings": {"film": {"width": 720, "height": 405}, "stop": {"spp": 256}, "path": {"max_depth": 8}, "display": {"tone_map": "filmic"}}
}
)";

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_many_lights FILE.json\n");
    return 2;
  }
  auto out = fmt::output_file(argv[1]);
  out.print("{}", kHead);
  for (int side : {-1, 1})
    for (int k = 0; k < 7; ++k) {
      const double x = side * 3.6, z = -15 + 5.0 * k;
      out.print(
          ",\n    {{\"shape\": \"cylinder\", \"radius\": 0.28, \"height\": 5.5, \"material\": \"column\", "
          "\"transform\": [{{\"rotate\": [1, 0, 0, -90]}}, {{\"translate\": [{:.2f}, 0, {:.2f}]}}]}}",
          x, z);
      out.print(",\n    {{\"shape\": \"sphere\", \"radius\": 0.45, \"material\": \"glaze\", "
                "\"transform\": [{{\"translate\": [{:.2f}, 0.45, {:.2f}]}}]}}",
                x * 0.62, z + 2.5);
    }
  for (int s = 0; s < kStrings; ++s)
    for (int k = 0; k < kLanterns; ++k) {
      // From wall to wall, sagging like a chain, each string with colours of its own; no lantern as its
      // neighbour is turned.
      const double t = (k + 0.5) / kLanterns * 2 - 1;
      const double x = t * (kHalfWidth - 0.15), z = ((s + 0.5) / kStrings - 0.5) * kLength;
      const double sag = 0.7 + 0.5 * std::sin(1.7 * s);
      const double y = 4.9 - 0.25 * std::cos(2.3 * s) - sag * (1 - t * t);
      const double turn = std::fmod(137.508 * (s * kLanterns + k), 360.0);
      const char* color = kColors[(s / 2 + (k % 7 == 3 ? 3 : 0)) % 6];
      out.print(",\n    {{\"shape\": \"cube\", \"material\": \"{}\", \"transform\": [{{\"scale\": {:.3f}}}, "
                "{{\"rotate\": [0.3, 1, 0.1, {:.1f}]}}, {{\"translate\": [{:.3f}, {:.3f}, {:.3f}]}}]}}",
                color, 0.045 + 0.02 * std::sin(0.9 * k + s), turn, x, y, z);
    }
  out.print("{}", kTail);
}
