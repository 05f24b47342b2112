#pragma once
// Small scenes defined in code, for tests with known results.

#include "scene/document.h"

namespace candela::test {

/// Builds a scene; functions return an index or *this, for chaining.
class SceneMaker {
public:
  Document document;

  SceneMaker(int width, int height, int spp) {
    document.settings.film.width = width;
    document.settings.film.height = height;
    document.settings.stop.spp = spp;
  }

  int material(Material m) {
    document.scene.materials.push_back(std::move(m));
    return static_cast<int>(document.scene.materials.size()) - 1;
  }
  int diffuse(vec3 reflectance, vec3 emission = vec3(0)) {
    Material m;
    m.model = DiffuseMaterial{reflectance};
    m.emission = emission;
    return material(m);
  }

  /// Corners center +- x +- y; the normal is along x cross y.
  void rectangle(vec3 center, vec3 x, vec3 y, int mat) {
    vec3 n = glm::normalize(glm::cross(x, y));
    mat4 m(vec4(x, 0), vec4(y, 0), vec4(n, 0), vec4(center, 1));
    document.scene.instances.push_back({"", RectangleShape{}, m, {mat}});
  }
  void sphere(vec3 center, float radius, int mat) {
    document.scene.instances.push_back({"", SphereShape{radius}, glm::translate(mat4(1), center), {mat}});
  }
  void disc(vec3 center, float radius, vec3 x, vec3 y, int mat) {
    vec3 n = glm::normalize(glm::cross(x, y));
    mat4 m(vec4(glm::normalize(x) * radius, 0), vec4(glm::normalize(y) * radius, 0), vec4(n * radius, 0),
           vec4(center, 1));
    document.scene.instances.push_back({"", DiscShape{}, m, {mat}});
  }
  void mesh(Mesh mesh, int mat, mat4 world_from_object = mat4(1)) {
    mesh_shared(std::make_shared<const Mesh>(std::move(mesh)), mat, world_from_object);
  }
  void mesh_shared(std::shared_ptr<const Mesh> mesh, int mat, mat4 world_from_object = mat4(1)) {
    document.scene.instances.push_back({"", std::move(mesh), world_from_object, {mat}});
  }
  /// Inward-facing walls of [lo, hi].
  void closed_box(vec3 lo, vec3 hi, int mat) {
    vec3 c = 0.5f * (lo + hi), h = 0.5f * (hi - lo);
    vec3 x(h.x, 0, 0), y(0, h.y, 0), z(0, 0, h.z);
    rectangle(c - x, y, z, mat);
    rectangle(c + x, z, y, mat);
    rectangle(c - y, z, x, mat);
    rectangle(c + y, x, z, mat);
    rectangle(c - z, x, y, mat);
    rectangle(c + z, y, x, mat);
  }
  void constant_light(vec3 radiance) {
    LightDesc l;
    l.model = ConstantLightModel{};
    l.color = radiance;
    document.scene.lights.push_back(l);
  }
  void camera(vec3 position, vec3 target, float vertical_fov_degrees, vec3 up = vec3(0, 1, 0)) {
    Camera& c = document.scene.camera;
    c.position = position;
    c.target = target;
    c.up = up;
    c.vertical_fov = radians(vertical_fov_degrees);
  }
};

/// The Cornell box with exact axis-aligned walls and the light flush in a hole of the ceiling (552.8 x 548.8
/// x 559.2), with its two blocks if `blocks`.
inline SceneMaker cornell_flush(int width, int height, int spp, bool blocks) {
  SceneMaker s(width, height, spp);
  int white = s.diffuse({0.725f, 0.71f, 0.68f}), red = s.diffuse({0.63f, 0.065f, 0.05f}),
      green = s.diffuse({0.14f, 0.45f, 0.091f}), light = s.diffuse({0.78f, 0.78f, 0.78f}, {17, 12, 4});
  const float X = 552.8f, Y = 548.8f, Z = 559.2f, x0 = 213, x1 = 343, z0 = 227, z1 = 332;
  auto flat = [&](vec3 lo, vec3 hi, int axis, bool positive, int mat) {
    vec3 c = 0.5f * (lo + hi), h = 0.5f * (hi - lo), a(0), b(0);
    int i = (axis + 1) % 3, j = (axis + 2) % 3;
    a[i] = h[i], b[j] = h[j];
    if (positive)
      s.rectangle(c, a, b, mat);
    else
      s.rectangle(c, b, a, mat);
  };
  flat({0, 0, 0}, {X, 0, Z}, 1, true, white);
  flat({0, 0, Z}, {X, Y, Z}, 2, false, white);
  flat({0, 0, 0}, {0, Y, Z}, 0, true, green); // the right wall as the camera sees it
  flat({X, 0, 0}, {X, Y, Z}, 0, false, red);
  flat({0, Y, 0}, {X, Y, z0}, 1, false, white); // the ceiling around the hole
  flat({0, Y, z1}, {X, Y, Z}, 1, false, white);
  flat({0, Y, z0}, {x0, Y, z1}, 1, false, white);
  flat({x1, Y, z0}, {X, Y, z1}, 1, false, white);
  flat({x0, Y, z0}, {x1, Y, z1}, 1, false, light);
  if (blocks) {
    auto block = [&](std::initializer_list<vec2> corners,
                     float top) { // counter-clockwise seen from above (-z up)
      Mesh m;
      for (vec2 c : corners) m.positions.emplace_back(c.x, 0, c.y), m.positions.emplace_back(c.x, top, c.y);
      for (std::uint32_t k = 0; k < 4; ++k) {
        std::uint32_t a = 2 * k, b = 2 * ((k + 1) % 4);
        m.triangles.emplace_back(a, b, b + 1);
        m.triangles.emplace_back(a, b + 1, a + 1);
      }
      m.triangles.emplace_back(1, 3, 5);
      m.triangles.emplace_back(1, 5, 7);
      s.mesh(std::move(m), white);
    };
    block({{130, 65}, {82, 225}, {240, 272}, {290, 114}}, 165);
    block({{423, 247}, {265, 296}, {314, 456}, {472, 406}}, 330);
  }
  s.camera({278, 273, -800}, {278, 273, 0}, 39.3077f);
  return s;
}

} // namespace candela::test
