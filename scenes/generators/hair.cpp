// Writes scenes/hair.json and scenes/curves/hair.curves: a head of hair. Roots lie on the scalp as a
// sunflower lays out its seeds (H. Vogel, "A better way to construct the sunflower head", Mathematical
// Biosciences 44, 1979); each strand leaves along the scalp's normal, is combed aside and falls, around the
// head.
//
//   cmake --build --preset release --target scene_data

#include "core/hash.h"
#include "io/curves/curves_file.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <numbers>

namespace {

using candela::vec3;

constexpr std::uint32_t kStrands = 10800;
constexpr int kPoints = 6;                ///< of a strand: three segments of a B-spline
constexpr double kScalp = 0.62;           ///< share of the head's sphere, from the crown down
constexpr vec3 kHead(0.76f, 1.0f, 0.88f); ///< half axes, about the origin
constexpr std::uint32_t kLocks = 420;

constexpr const char* kScene = R"({
  "candela": 1,
  "description": "A head of 10,800 strands, each a B-spline of three segments whose width shrinks to the tip: hair as Chiang et al. 2016 have it, in near field. Light goes through a strand, and is coloured by it, more often than it is absorbed: compare path.max_depth = 2 and -1. Set eumelanin to 0.3 for blonde and 8 for black, beta_n for how matte it is; make form = ribbon. Written by scenes/generators/hair.cpp.",

  "camera": {"position": [-1.9, 0.5, 4.6], "target": [0, -0.28, 0], "vertical_fov": 36},

  "materials": [
    {"name": "hair", "type": "hair", "parametrization": "melanin", "eumelanin": 0.9, "pheomelanin": 0.55, "beta_m": 0.25, "beta_n": 0.3},
    {"name": "wood", "type": "plastic", "diffuse": [0.46, 0.3, 0.19], "roughness": 0.35},
    {"name": "wall", "diffuse": [0.32, 0.34, 0.36]},
    {"name": "key", "diffuse": 0, "emission": [21, 19, 17]},
    {"name": "rim", "diffuse": 0, "emission": [30, 32, 36]}
  ],

  "lights": [{"name": "room", "type": "constant", "color": [0.16, 0.17, 0.19]}],

  "instances": [
    {"name": "hair", "shape": "curves", "file": "curves/hair.curves", "material": "hair"},
    {"name": "head", "shape": "sphere", "material": "wood", "transform": [{"scale": [0.755, 0.995, 0.875]}]},
    {"name": "nose", "shape": "sphere", "material": "wood",
     "transform": [{"scale": [0.1, 0.2, 0.14]}, {"rotate": [1, 0, 0, -14]}, {"translate": [0, -0.22, 0.86]}]},
    {"name": "chin", "shape": "sphere", "material": "wood",
     "transform": [{"scale": [0.46, 0.4, 0.5]}, {"translate": [0, -0.72, 0.3]}]},
    {"name": "neck", "shape": "cylinder", "radius": 0.34, "height": 1.2, "material": "wood",
     "transform": [{"rotate": [1, 0, 0, 90]}, {"translate": [0, -0.6, -0.08]}]},
    {"name": "floor", "shape": "plane", "material": "wall", "transform": [{"rotate": [1, 0, 0, -90]}, {"translate": [0, -1.75, 0]}]},
    {"name": "wall", "shape": "plane", "material": "wall", "transform": [{"translate": [0, 0, -4]}]},
    {"name": "key", "shape": "rectangle", "material": "key",
     "transform": [{"scale": 0.8}, {"look_at": {"origin": [-3, 3.2, 3.4], "target": [0, 0, 0], "up": [0, 1, 0]}}]},
    {"name": "rim", "shape": "rectangle", "material": "rim",
     "transform": [{"scale": 0.6}, {"look_at": {"origin": [3.4, 2.6, -1.6], "target": [0, 0.2, 0], "up": [0, 1, 0]}}]}
  ],

  "settings": {"film": {"width": 640, "height": 640}, "stop": {"spp": 256}, "display": {"tone_map": "filmic"}}
}
)";

/// A number from -1 to 1 of a strand or lock, another one for every salt.
float noise(std::uint32_t index, std::uint64_t salt) {
  return 2 * candela::to_unit_float(static_cast<std::uint32_t>(candela::hash64(index * 64ull + salt) >> 32)) -
         1;
}
vec3 noise3(std::uint32_t index, std::uint64_t salt) {
  return {noise(index, salt), noise(index, salt + 1), noise(index, salt + 2)};
}

/// Out of the head, with a little air between.
vec3 outside(vec3 p, float air) {
  const float r = glm::length(p / kHead), least = 1 + air;
  return r < least ? p * (least / r) : p;
}

vec3 root_direction(std::uint32_t k, std::uint32_t n) {
  const double y = 1 - 2 * kScalp * (k + 0.5) / n, s = std::sqrt(1 - y * y);
  const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
  return vec3(s * std::sin(angle), y, s * std::cos(angle));
}

/// No hair grows on the face.
bool is_face(vec3 d) { return d.z > 0.25f && d.y < 0.62f - 0.5f * std::abs(d.x); }

void add_strand(candela::Strands& out, std::uint32_t k, vec3 d) {
  const vec3 root = kHead * d, normal = glm::normalize(d / kHead);
  // From a parting on the left, forward and to the sides; what grows behind falls down the back.
  const float side = d.x < -0.22f ? -1.0f : 1.0f;
  const vec3 comb = glm::normalize(vec3(side * 0.9f, -0.25f, d.z > 0 ? 0.35f : -0.5f));
  const auto lock = static_cast<std::uint32_t>((0.5f + 0.5f * noise(k, 9)) * static_cast<float>(kLocks));
  const float length = (1.45f + 0.12f * noise(k, 3)) * (0.8f + 0.3f * (0.6f - d.y));
  const float step = length / (kPoints - 2.5f);
  vec3 direction = glm::normalize(0.55f * normal + comb * 0.8f + 0.2f * noise3(k, 16));
  vec3 p = root - 0.6f * step * normal;
  for (int i = 0; i < kPoints; ++i) {
    out.points.push_back(p);
    if (i == 0)
      p = root;
    else
      p = outside(p + step * direction, 0.03f + 0.1f * (0.5f + 0.5f * noise(k, 5)));
    const float wave = 0.22f * static_cast<float>(i);
    direction = glm::normalize(direction + comb * 0.1f + vec3(0, -1.3f, 0) + wave * noise3(lock, 24) +
                               0.14f * noise3(k, 32 + 4 * static_cast<std::uint64_t>(i)));
  }
  out.counts.push_back(kPoints);
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: make_hair FILE.json FILE.curves\n");
    return 2;
  }
  candela::Strands hair;
  hair.widths = {0.0085f, 0.0025f};
  // More seeds than strands, for the face takes some.
  std::uint32_t seeds = kStrands, missing = 0;
  do {
    seeds += missing;
    missing = kStrands;
    for (std::uint32_t k = 0; k < seeds && missing > 0; ++k)
      missing -= is_face(root_direction(k, seeds)) ? 0 : 1;
  } while (missing > 0);
  for (std::uint32_t k = 0; k < seeds && hair.counts.size() < kStrands; ++k)
    if (const vec3 d = root_direction(k, seeds); !is_face(d)) add_strand(hair, k, d);
  candela::write_curves_file(hair, argv[2]);
  auto out = fmt::output_file(argv[1]);
  out.print("{}", kScene);
}
