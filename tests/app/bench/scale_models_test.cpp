#include "app/bench/scale_models.h"
#include "app/bench/scale_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <tuple>

namespace candela {
namespace {

using Point = std::array<float, 3>;
Point point(vec3 p) { return {p.x, p.y, p.z}; }

std::array<Point, 3> corners(const Mesh& mesh, uvec3 t) {
  std::array<Point, 3> out{point(mesh.positions[t.x]), point(mesh.positions[t.y]),
                           point(mesh.positions[t.z])};
  std::ranges::sort(out);
  return out;
}

vec3 area_vector(const Mesh& mesh, uvec3 t) {
  return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
}

/// Requirements on every generated mesh: complete attributes, unit normals, distinct triangles with an area
/// and with the orientation of their normals.
void expect_sound(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (vec3 n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-5);
  for (vec2 uv : mesh.uvs) ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
  std::set<std::array<Point, 3>> distinct;
  std::size_t facing = 0;
  for (uvec3 t : mesh.triangles) {
    const vec3 area = area_vector(mesh, t);
    ASSERT_GT(glm::length(area), 0);
    facing += glm::dot(area, mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]) > 0;
    distinct.insert(corners(mesh, t));
  }
  EXPECT_EQ(distinct.size(), mesh.triangles.size());
  // At edges that the mesh does not resolve, the mean of three normals may point to the other side.
  EXPECT_GT(static_cast<double>(facing), 0.99 * static_cast<double>(mesh.triangles.size()));
}

TEST(ScaleModels, MountainsHaveTheTrianglesAskedForAndNoTwoAlike) {
  for (std::size_t n : {1'000u, 4'000u, 60'000u}) {
    const Mesh mesh = mountain_mesh(n);
    EXPECT_GE(mesh.triangles.size(), n);
    EXPECT_LE(mesh.triangles.size(), n + n / 20);
    EXPECT_EQ(mesh.slot_names.size(), 2u);
    EXPECT_EQ(mesh.material_slots.size(), mesh.triangles.size());
    EXPECT_EQ(mesh.material_slots.front(), 0u);
    EXPECT_EQ(mesh.material_slots.back(), 1u);
    expect_sound(mesh);
  }
}

TEST(ScaleModels, MountainsAreTheSameEveryTime) { EXPECT_EQ(mountain_mesh(5'000), mountain_mesh(5'000)); }

TEST(ScaleModels, FinerMountainsComeCloserToTheSameMountains) {
  double last = 0.5; // scene units; the mountains are some 6 high
  for (std::size_t n : {1'000u, 16'000u, 256'000u}) {
    const Mesh mesh = mountain_mesh(n);
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; mesh.material_slots[i] == 0; i += 7, ++count) { // the ground
      const vec3 p = mesh.positions[mesh.triangles[i].x];
      sum += std::abs(static_cast<double>(p.y) - mountain_height(glm::dvec2(p.x, p.z)));
    }
    EXPECT_LT(sum / count, last);
    last = 0.4 * sum / count; // four times finer
  }
}

TEST(ScaleModels, StonesAreClosed) {
  const Mesh mesh = stone_mesh(12, 7);
  EXPECT_EQ(mesh.triangles.size(), 12u * 12 * 12);
  expect_sound(mesh);
  // Shared points of the cube's faces are computed twice, by different formulas.
  constexpr float kWeld = 1e-4f;
  auto welded = [&](std::uint32_t i) {
    const vec3 p = glm::round(mesh.positions[i] / kWeld);
    return std::tuple(p.x, p.y, p.z);
  };
  using Welded = decltype(welded(0));
  std::map<std::pair<Welded, Welded>, int> edges;
  double volume = 0;
  for (uvec3 t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{welded(t[k]), welded(t[(k + 1) % 3])}];
    volume += static_cast<double>(glm::dot(mesh.positions[t.x], area_vector(mesh, t))) / 6;
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_GT(volume, 1); // outside is outside
  EXPECT_LT(volume, 5);
  EXPECT_NE(stone_mesh(12, 8).positions, mesh.positions);
}

TEST(ScaleModels, TexturesHaveColoursThatSurfacesHave) {
  for (const Texels& texels : {mountain_texture(64), stone_texture(64)}) {
    const auto bytes = srgb8_texels(texels);
    ASSERT_EQ(bytes.size(), 64u * 64 * 3);
    const auto [lo, hi] = std::ranges::minmax(bytes);
    EXPECT_GT(lo, 10); // nothing is quite black, nothing is quite white, and not all is the same
    EXPECT_LT(hi, 250);
    EXPECT_GT(hi - lo, 60);
  }
  EXPECT_EQ(mountain_texture(64), mountain_texture(64));
}

TEST(ScaleNoise, GradientIsTheSlopeOfTheValue) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    const glm::dvec2 p(20 * hashed_unit(i, 1) - 10, 20 * hashed_unit(i, 2) - 10);
    const double h = 1e-5;
    auto value = [](glm::dvec2 q) { return gradient_noise(q, 5).value; };
    const glm::dvec2 g = gradient_noise(p, 5).gradient;
    EXPECT_NEAR(g.x, (value(p + glm::dvec2(h, 0)) - value(p - glm::dvec2(h, 0))) / (2 * h), 1e-7);
    EXPECT_NEAR(g.y, (value(p + glm::dvec2(0, h)) - value(p - glm::dvec2(0, h))) / (2 * h), 1e-7);
  }
}

TEST(ScaleNoise, IsContinuousAcrossCells) {
  for (double x : {-3.0, 0.0, 2.0})
    for (double y : {-1.3, 0.6}) {
      const double e = 1e-9;
      EXPECT_NEAR(gradient_noise(glm::dvec2(x - e, y), 3).value,
                  gradient_noise(glm::dvec2(x + e, y), 3).value, 1e-7);
      EXPECT_NEAR(gradient_noise(glm::dvec3(x - e, y, 0.2), 3), gradient_noise(glm::dvec3(x + e, y, 0.2), 3),
                  1e-7);
      EXPECT_NEAR(gradient_noise(glm::dvec3(0.4, y, x - e), 3), gradient_noise(glm::dvec3(0.4, y, x + e), 3),
                  1e-7);
    }
}

} // namespace
} // namespace candela
