#include "render/world/shape_mesh.h"

namespace candela {

namespace {

constexpr std::uint32_t kSegments = 512;
constexpr std::uint32_t kTorusSegments = 256, kTubeSegments = 128;
constexpr int kPlaneDoublings = 14;

/// The i-th of n points of the unit circle; the same bits for i = 0 and i = n, so that seams close.
vec2 circle_point(std::uint32_t i, std::uint32_t n) {
  double phi = 2 * std::numbers::pi * (i % n) / n;
  return {static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi))};
}

float share(std::uint32_t i, std::uint32_t n) { return static_cast<float>(i) / static_cast<float>(n); }

std::uint32_t add_vertex(Mesh& mesh, vec3 position, vec3 normal, vec2 uv) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
}

/// A disc of radius 1 at the height z that faces `side`, +1 or -1 times z.
void add_cap(Mesh& mesh, float z, float side) {
  vec3 normal(0, 0, side);
  std::uint32_t center = add_vertex(mesh, {0, 0, z}, normal, vec2(0.5f));
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    vec2 p = circle_point(i, kSegments);
    add_vertex(mesh, vec3(p, z), normal, 0.5f * vec2(p.x, side * p.y) + 0.5f);
  }
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    std::uint32_t a = center + 1 + i, b = center + 1 + (i + 1) % kSegments;
    mesh.triangles.push_back(side > 0 ? uvec3(center, a, b) : uvec3(center, b, a));
  }
}

Mesh cylinder(bool caps) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kSegments; ++i)
    for (float z : {0.0f, 1.0f}) {
      vec2 p = circle_point(i, kSegments);
      add_vertex(mesh, vec3(p, z), vec3(p, 0), {share(i, kSegments), z});
    }
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    std::uint32_t a = 2 * i;
    mesh.triangles.emplace_back(a, a + 2, a + 3);
    mesh.triangles.emplace_back(a, a + 3, a + 1);
  }
  if (caps) add_cap(mesh, 0, -1), add_cap(mesh, 1, 1);
  return mesh;
}

/// Each triangle has an apex of its own, whose normal is that of its middle.
Mesh cone(bool caps) {
  const float slope = 1 / std::sqrt(2.0f); // of the side's normal, radius and height being 1
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kSegments; ++i) {
    vec2 p = circle_point(i, kSegments);
    add_vertex(mesh, vec3(p, 0), vec3(slope * p, slope), {share(i, kSegments), 0});
  }
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    vec2 p = circle_point(2 * i + 1, 2 * kSegments);
    std::uint32_t apex =
        add_vertex(mesh, {0, 0, 1}, vec3(slope * p, slope), {share(2 * i + 1, 2 * kSegments), 1});
    mesh.triangles.emplace_back(i, i + 1, apex);
  }
  if (caps) add_cap(mesh, 0, -1);
  return mesh;
}

Mesh torus(float minor_radius) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kTorusSegments; ++i)
    for (std::uint32_t j = 0; j <= kTubeSegments; ++j) {
      vec2 p = circle_point(i, kTorusSegments), q = circle_point(j, kTubeSegments);
      vec3 normal(q.x * p, q.y);
      add_vertex(mesh, vec3((1 + minor_radius * q.x) * p, minor_radius * q.y), normal,
                 {share(i, kTorusSegments), share(j, kTubeSegments)});
    }
  for (std::uint32_t i = 0; i < kTorusSegments; ++i)
    for (std::uint32_t j = 0; j < kTubeSegments; ++j) {
      std::uint32_t a = i * (kTubeSegments + 1) + j, b = a + kTubeSegments + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  return mesh;
}

Mesh cube() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {1.0f, -1.0f}) {
      vec3 n(0), right(0), up(0);
      n[axis] = side, right[(axis + 1) % 3] = side, up[(axis + 2) % 3] = 1;
      std::uint32_t a = 0;
      for (vec2 uv : {vec2(1, 1), vec2(0, 1), vec2(0, 0), vec2(1, 0)})
        a = add_vertex(mesh, n + (2 * uv.x - 1) * right + (2 * uv.y - 1) * up, n, uv);
      mesh.triangles.emplace_back(a - 3, a - 2, a - 1);
      mesh.triangles.emplace_back(a - 3, a - 1, a);
    }
  return mesh;
}

/// Its triangles' edges are not longer than their distance from the origin (or than 1): what the rounding of
/// a ray's test takes from a triangle's size then grows with the distance, as that of the point itself does.
Mesh plane() {
  std::vector<float> lines{0};
  for (int i = 0; i <= kPlaneDoublings; ++i) lines.push_back(std::ldexp(1.0f, i));
  for (int i = 0; i <= kPlaneDoublings; ++i) lines.insert(lines.begin(), -std::ldexp(1.0f, i));
  Mesh mesh;
  for (float y : lines)
    for (float x : lines) add_vertex(mesh, {x, y, 0}, {0, 0, 1}, {x, y});
  auto n = static_cast<std::uint32_t>(lines.size());
  for (std::uint32_t j = 0; j + 1 < n; ++j)
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      std::uint32_t a = j * n + i;
      mesh.triangles.emplace_back(a, a + 1, a + n + 1);
      mesh.triangles.emplace_back(a, a + n + 1, a + n);
    }
  return mesh;
}

} // namespace

std::optional<MeshedShape> meshed_shape(const Shape& shape) {
  auto scaled = [](const Shape& standard, float radius, float height) {
    return MeshedShape{standard, glm::scale(mat4(1), {radius, radius, height})};
  };
  if (std::holds_alternative<PlaneShape>(shape) || std::holds_alternative<CubeShape>(shape)) {
    MeshedShape same; // assigned: g++ 12 suspects a temporary of not being initialised
    same.standard = shape;
    return same;
  }
  if (const auto* c = std::get_if<CylinderShape>(&shape))
    return scaled(CylinderShape{1, 1, c->caps}, c->radius, c->height);
  if (const auto* c = std::get_if<ConeShape>(&shape))
    return scaled(ConeShape{1, 1, c->caps}, c->radius, c->height);
  if (const auto* t = std::get_if<TorusShape>(&shape))
    return scaled(TorusShape{1, t->minor_radius / t->radius}, t->radius, t->radius);
  return std::nullopt;
}

Mesh shape_mesh(const Shape& standard) {
  if (const auto* c = std::get_if<CylinderShape>(&standard)) return cylinder(c->caps);
  if (const auto* c = std::get_if<ConeShape>(&standard)) return cone(c->caps);
  if (const auto* t = std::get_if<TorusShape>(&standard)) return torus(t->minor_radius);
  return std::holds_alternative<CubeShape>(standard) ? cube() : plane();
}

} // namespace candela
