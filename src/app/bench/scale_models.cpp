#include "app/bench/scale_models.h"

#include "app/bench/scale_noise.h"
#include "core/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace candela {

namespace {

// The ground extends from kNear to kFar along z and kHalfWidth to either side. Its cells are smallest near
// the middle of the near edge, where the camera is: by this factor smaller than the mean.
constexpr double kNear = 3, kFar = -21, kHalfWidth = 17;
constexpr double kNearScale = 0.25, kCentralScale = 0.3;
constexpr std::uint32_t kBoulders = 48;
constexpr double kBoulderShare = 0.15; ///< of the triangles

double smooth_step(double lo, double hi, double x) {
  const double t = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The ground's point (x, z) at uv; v grows towards -z.
glm::dvec2 ground_point(glm::dvec2 uv) {
  const double s = 2 * uv.x - 1, t = uv.y;
  return {kHalfWidth * s * (kCentralScale + (1 - kCentralScale) * s * s),
          kNear + (kFar - kNear) * t * (kNearScale + (1 - kNearScale) * t)};
}

/// The larger side of the cell there, of a ground with so many cells in a row.
double cell_size(glm::dvec2 uv, double cells) {
  const double s = 2 * uv.x - 1, t = uv.y;
  return std::max(2 * kHalfWidth * (kCentralScale + 3 * (1 - kCentralScale) * s * s),
                  (kNear - kFar) * (kNearScale + 2 * (1 - kNearScale) * t)) /
         cells;
}

double length_squared(glm::dvec2 v) { return glm::dot(v, v); }

void set_texel(Texels& texture, int x, int y, glm::dvec3 linear) {
  auto& bytes = std::get<std::vector<std::uint8_t>>(texture.data);
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                              static_cast<std::size_t>(x));
  for (std::size_t c = 0; c < 3; ++c) {
    const float v = srgb_from_linear(std::clamp(static_cast<float>(linear[static_cast<int>(c)]), 0.0f, 1.0f));
    bytes[at + c] = static_cast<std::uint8_t>(v * 255 + 0.5f);
  }
}

Texels empty_texture(int size) {
  Texels out{size, size, 3, {}};
  out.data = std::vector<std::uint8_t>(3 * out.texel_count());
  return out;
}

/// The two triangles of a cell, split along the shorter diagonal.
void add_cell(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto& p = mesh.positions;
  if (length_squared(p[a] - p[c]) <= length_squared(p[b] - p[d])) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  } else {
    mesh.triangles.emplace_back(a, b, d);
    mesh.triangles.emplace_back(b, c, d);
  }
}

void add_ground(Mesh& mesh, std::uint32_t cells) {
  const std::uint32_t side = cells + 1;
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) {
      const glm::dvec2 uv(static_cast<double>(i) / cells, static_cast<double>(j) / cells);
      const glm::dvec2 p = ground_point(uv);
      mesh.positions.emplace_back(p.x, mountain_height(p, cell_size(uv, cells)), p.y);
      mesh.uvs.emplace_back(uv);
    }
  auto at = [&](std::uint32_t i, std::uint32_t j) {
    return mesh.positions[std::min(j, cells) * side + std::min(i, cells)];
  };
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) {
      const vec3 along_u = at(i + 1, j) - at(i > 0 ? i - 1 : 0, j);
      const vec3 along_v = at(i, j + 1) - at(i, j > 0 ? j - 1 : 0);
      mesh.normals.push_back(glm::normalize(glm::cross(along_u, along_v)));
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * side + i;
      add_cell(mesh, a, a + 1, a + side + 1, a + side);
    }
}

/// The index-th flat place in the valley.
glm::dvec2 boulder_place(std::uint32_t index) {
  constexpr double kReach = 0.5, kSteepest = 0.35, kStep = 0.05;
  glm::dvec2 p(0);
  for (std::uint32_t attempt = 0; attempt < 64; ++attempt) {
    const std::uint32_t draw = 64 * index + attempt;
    p = ground_point({0.5 + kReach * (hashed_unit(draw, 1) - 0.5), 0.2 + kReach * hashed_unit(draw, 2)});
    const glm::dvec2 slope(mountain_height(p + glm::dvec2(kStep, 0)) - mountain_height(p),
                           mountain_height(p + glm::dvec2(0, kStep)) - mountain_height(p));
    if (length_squared(slope) < kSteepest * kSteepest * kStep * kStep) break;
  }
  return p;
}

/// A face of a stone: the half space n.d <= distance.
struct Cut {
  glm::dvec3 normal;
  double distance;
};

class StoneShape {
public:
  StoneShape(int cells, std::uint32_t seed)
      : seed_(seed), octaves_(std::clamp(static_cast<int>(std::log2(cells)), 1, 8)) {
    for (std::uint32_t i = 0; i < kCuts; ++i) {
      const double z = 1 - 2 * (i + hashed_unit(i, seed)) / kCuts;
      const double phi = 2 * std::numbers::pi * hashed_unit(i + kCuts, seed);
      const double r = std::sqrt(1 - z * z);
      cuts_[i] = {{r * std::cos(phi), r * std::sin(phi), z}, 0.68 + 0.3 * hashed_unit(i + 2 * kCuts, seed)};
    }
  }

  /// In the unit direction d.
  glm::dvec3 point(glm::dvec3 d) const {
    // The norm of order 16 of all 1 / (distance along d): the nearest face, with rounded edges.
    auto power16 = [](double x) { return x *= x, x *= x, x *= x, x * x; };
    double sum = power16(1 / 1.15);
    for (const Cut& cut : cuts_)
      if (const double c = glm::dot(d, cut.normal); c > 0) sum += power16(c / cut.distance);
    const double radius = 1 / std::sqrt(std::sqrt(std::sqrt(std::sqrt(sum))));
    return d * (radius * (1 + 0.22 * fractal_noise(d * 1.7, octaves_, seed_)));
  }

private:
  static constexpr std::uint32_t kCuts = 16;
  std::uint32_t seed_;
  int octaves_; ///< no finer than the cells can represent
  std::array<Cut, kCuts> cuts_;
};

} // namespace

double mountain_height(glm::dvec2 p, double spacing) {
  // Octaves are weaker where the coarser ones are steep, so that slopes are smooth and crests rough, like
  // eroded terrain (after I. Quilez, "Value noise derivatives", 2008).
  constexpr int kOctaves = 13;
  constexpr double kFrequency = 0.13;
  glm::dvec2 q = p * kFrequency + glm::dvec2(3.7, 1.9), slope(0);
  double sum = 0, strength = 1;
  for (int i = 0; i < kOctaves; ++i) {
    // Faded out near two samples a wave, the Nyquist limit: finer octaves would alias.
    const double samples_a_wave = spacing > 0 ? strength / (kFrequency * spacing) : 4;
    const double share = smooth_step(1.5, 3, samples_a_wave);
    if (share <= 0) break;
    const NoiseSample n = gradient_noise(q, static_cast<std::uint32_t>(i));
    slope += n.gradient * (0.7 * share);
    sum += share * strength * n.value / (1 + glm::dot(slope, slope));
    strength *= 0.5;
    q = 2.0 * glm::dvec2(0.8 * q.x + 0.6 * q.y,
                         0.8 * q.y - 0.6 * q.x); // rotated, so that the octaves' lattices do not align
  }
  const double valley = smooth_step(1.5, 13, glm::length(p));
  return (1.2 + 5 * valley) * sum + 2.2 * valley;
}

Mesh mountain_mesh(std::size_t triangles) {
  Mesh mesh;
  mesh.name = "mountains";
  mesh.slot_names = {"ground", "boulder"};
  const auto n = static_cast<double>(triangles);
  const int stone_cells = std::max(1, static_cast<int>(std::sqrt(kBoulderShare * n / (12 * kBoulders))));
  const double rest = n - 12.0 * kBoulders * stone_cells * stone_cells;
  add_ground(mesh, static_cast<std::uint32_t>(std::ceil(std::sqrt(rest / 2))));
  mesh.material_slots.resize(mesh.triangles.size(), 0);
  for (std::uint32_t i = 0; i < kBoulders; ++i) {
    const Mesh stone = stone_mesh(stone_cells, 100 + i);
    const glm::dvec2 p = boulder_place(i);
    const double size = 0.03 + 0.2 * std::pow(hashed_unit(i, 3), 3.0);
    const vec3 center(p.x, mountain_height(p) + 0.25 * size, p.y);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (vec3 v : stone.positions) mesh.positions.push_back(center + static_cast<float>(size) * v);
    mesh.normals.insert(mesh.normals.end(), stone.normals.begin(), stone.normals.end());
    mesh.uvs.insert(mesh.uvs.end(), stone.uvs.begin(), stone.uvs.end());
    for (uvec3 t : stone.triangles) mesh.triangles.push_back(t + base);
  }
  mesh.material_slots.resize(mesh.triangles.size(), 1);
  return mesh;
}

Texels mountain_texture(int size) {
  Texels out = empty_texture(size);
  const glm::dvec3 grass(0.075, 0.09, 0.03), dry(0.17, 0.14, 0.06), dark_rock(0.13, 0.115, 0.1),
      light_rock(0.3, 0.265, 0.23), scree(0.26, 0.235, 0.205), snow(0.82, 0.84, 0.87);
  const double step = 1.0 / size;
  /// Texture coordinates of a texel's centre, or of its lower left corner.
  auto place = [&](int x, int y, double offset) {
    return ground_point({(x + offset) * step, 1 - (y + 1 - offset) * step});
  };
  const auto side = static_cast<std::size_t>(size) + 1;
  std::vector<float> corners(side * side); // heights; slopes are differences between neighbours
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = -1; y < size; ++y)
    for (int x = 0; x <= size; ++x)
      corners[static_cast<std::size_t>(y + 1) * side + static_cast<std::size_t>(x)] =
          static_cast<float>(mountain_height(place(x, y, 0)));
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float* upper = &corners[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
      const float* lower = upper + side;
      const double h = 0.25 * static_cast<double>(upper[0] + upper[1] + lower[0] + lower[1]);
      const glm::dvec2 p = place(x, y, 0.5), extent = place(x + 1, y - 1, 0) - place(x, y, 0);
      const glm::dvec2 slope =
          0.5 *
          glm::dvec2(upper[1] + lower[1] - upper[0] - lower[0], upper[0] + upper[1] - lower[0] - lower[1]) /
          extent;
      const double flat = 1 / std::sqrt(1 + glm::dot(slope, slope)); // cosine of the angle to level ground
      const double large = fractal_noise(p * 0.8, 4, 20), small = fractal_noise(p * 9.0, 5, 30);
      const double strata = fractal_noise(glm::dvec2(h * 5 + 0.7 * large, 0.15 * p.x), 4, 40);
      glm::dvec3 color = glm::mix(dark_rock, light_rock, smooth_step(-0.5, 0.55, strata + 0.9 * small));
      color = glm::mix(color, scree, smooth_step(0.68, 0.82, flat + 0.12 * small));
      const glm::dvec3 meadow = glm::mix(grass, dry, smooth_step(-0.3, 0.4, large + 0.6 * small));
      color = glm::mix(color, meadow,
                       smooth_step(0.72, 0.86, flat + 0.1 * large) *
                           (1 - smooth_step(1.2, 2.4, h + 0.8 * large)));
      color = glm::mix(color, snow,
                       smooth_step(2.5, 3.1, h + 0.9 * large + 0.2 * small) *
                           smooth_step(0.55, 0.68, flat + 0.1 * small));
      set_texel(out, x, y, color);
    }
  return out;
}

Mesh stone_mesh(int cells, std::uint32_t seed) {
  const StoneShape shape(cells, seed);
  Mesh mesh;
  mesh.name = "stone";
  const auto side = static_cast<std::uint32_t>(cells) + 1;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double sign = face % 2 == 0 ? 1 : -1;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t j = 0; j < side; ++j)
      for (std::uint32_t i = 0; i < side; ++i) {
        const glm::dvec2 uv(static_cast<double>(i) / cells, static_cast<double>(j) / cells);
        // A cube on the sphere; equal angles make its cells about equal.
        const double angle = std::numbers::pi / 4;
        glm::dvec3 d;
        d[axis] = sign;
        d[(axis + 1) % 3] = sign * std::tan(angle * (2 * uv.x - 1));
        d[(axis + 2) % 3] = std::tan(angle * (2 * uv.y - 1));
        d = glm::normalize(d);
        const glm::dvec3 t = glm::normalize(glm::cross(d, glm::dvec3(axis == 1, axis == 2, axis == 0)));
        const glm::dvec3 b = glm::cross(d, t), p = shape.point(d);
        constexpr double kStep = 0.004;
        const glm::dvec3 pt = shape.point(glm::normalize(d + kStep * t)),
                         pb = shape.point(glm::normalize(d + kStep * b));
        mesh.positions.emplace_back(p);
        mesh.normals.emplace_back(glm::normalize(glm::cross(pt - p, pb - p)));
        mesh.uvs.emplace_back(uv);
      }
    for (std::uint32_t j = 0; j + 1 < side; ++j)
      for (std::uint32_t i = 0; i + 1 < side; ++i) {
        const std::uint32_t a = base + j * side + i;
        add_cell(mesh, a, a + 1, a + side + 1, a + side);
      }
  }
  return mesh;
}

Texels stone_texture(int size) {
  Texels out = empty_texture(size);
  const glm::dvec3 dark(0.16, 0.15, 0.135), light(0.42, 0.39, 0.35), lichen(0.36, 0.33, 0.13);
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec2 p = 6.0 * glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size);
      const double veins = fractal_noise(p + 0.8 * fractal_noise(p, 4, 60), 7, 70);
      const double patches = fractal_noise(p * 0.9, 6, 80);
      glm::dvec3 color = glm::mix(dark, light, smooth_step(-0.45, 0.5, veins));
      color = glm::mix(color, lichen, 0.8 * smooth_step(0.22, 0.34, patches));
      set_texel(out, x, y, color);
    }
  return out;
}

} // namespace candela
