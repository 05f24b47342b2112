// Writes scenes/ten_thousand_spheres.json: balls laid out as a sunflower lays out its seeds, the k-th at the
// radius c sqrt(k) and k golden angles (H. Vogel, "A better way to construct the sunflower head",
// Mathematical Biosciences 44, 1979), so that they are equally dense everywhere and never in rows.
//
//   cmake --build --preset release --target scene_data

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace {

constexpr int kBalls = 10000;
constexpr double kSpacing = 0.21; ///< c: the nearest neighbours are 1.55 c apart or more
constexpr int kLampEvery = 234;   ///< one more than a Fibonacci number: the lamps are a sunflower, too

constexpr const char* kHead = R"({
  "candela": 1,
  "description": "Ten thousand balls laid out like the seeds of a sunflower, and 42 of them are lamps, all of which a shadow ray might choose. Finding the nearest of so many balls takes a tree of boxes: view = bvh_cost shows how many boxes and balls each camera ray looks at. Compare path.light_samples = 1 and 16 at equal time, and path.light_sampling = bsdf, which has to find the lamps by luck. Written by scenes/generators/ten_thousand_spheres.cpp.",

  "camera": {"position": [0, 15, 25], "target": [0, -0.6, 2.6], "vertical_fov": 38},

  "materials": [
    {"name": "earth", "diffuse": [0.12, 0.11, 0.1]},
    {"name": "cream", "diffuse": [0.78, 0.7, 0.55]},
    {"name": "ochre", "diffuse": [0.72, 0.45, 0.1]},
    {"name": "rust", "diffuse": [0.58, 0.2, 0.08]},
    {"name": "moss", "diffuse": [0.2, 0.34, 0.12]},
    {"name": "slate", "diffuse": [0.14, 0.22, 0.33]},
    {"name": "gold", "type": "ggx", "specular": [1, 0.74, 0.34], "roughness": 0.28},
    {"name": "glass", "type": "dielectric", "ior": 1.5},
    {"name": "lamp", "diffuse": 0, "emission": [62, 42, 20]}
  ],

  "lights": [{"name": "night", "type": "constant", "color": [0.2, 0.27, 0.42]}],

  "instances": [
    {"name": "earth", "shape": "plane", "material": "earth", "transform": [{"rotate": [1, 0, 0, -90]}]})";

constexpr const char* kTail = R"(
  ],

  "settings": {"film": {"width": 720, "height": 405}, "stop": {"spp": 256}, "display": {"tone_map": "filmic"}}
}
)";

const char* material_of(int k) {
  constexpr const char* kSpirals[] = {"cream", "ochre", "rust", "moss", "slate"};
  if (k % kLampEvery == 0 && k > 0) return "lamp";
  if (k % 56 == 5) return "glass";
  if (k % 35 == 3) return "gold";
  return kSpirals[(k % 89) * 5 / 89];
}

/// A dome that ends on the ground, with a rim rising around it.
double height_at(double r) {
  constexpr double kRim = 15.5;
  return 3.4 * std::exp(-r * r / 26) + 1.5 * std::exp(-(r - kRim) * (r - kRim) / 5);
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_ten_thousand_spheres FILE.json\n");
    return 2;
  }
  auto out = fmt::output_file(argv[1]);
  out.print("{}", kHead);
  for (int k = 0; k < kBalls; ++k) {
    const double r = kSpacing * std::sqrt(k + 0.5);
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const bool lamp = std::string_view(material_of(k)) == "lamp";
    const double radius = lamp ? 0.2 : 0.16;
    const double y = height_at(r) + radius + (lamp ? 1 : 0); // lamps float
    out.print(",\n    {{\"shape\": \"sphere\", \"radius\": {}, \"material\": \"{}\", \"transform\": "
              "[{{\"translate\": "
              "[{:.3f}, {:.3f}, {:.3f}]}}]}}",
              radius, material_of(k), r * std::sin(angle), y, r * std::cos(angle));
  }
  out.print("{}", kTail);
}
