#pragma once
// Scenes in motion, and the same frozen at a time.

#include "render/render_testing.h"
#include "scene/motion.h"

namespace candela::test {

/// The scene as it is at a time, with nothing in it that moves.
inline Document frozen(Document document, float time) {
  for (Instance& instance : document.scene.instances) {
    instance.world_from_object = world_from_object(instance, time);
    instance.motion = {};
    const auto* shape = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
    if (shape == nullptr || !(*shape)->deforms()) continue;
    Mesh mesh = **shape;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      mesh.positions[i] = at_time(mesh.positions[i], mesh.positions_end[i], time);
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
      mesh.normals[i] = at_time(mesh.normals[i], mesh.normals_end[i], time);
    mesh.positions_end.clear(), mesh.normals_end.clear();
    instance.shape = std::make_shared<const Mesh>(std::move(mesh));
  }
  return document;
}

inline void open_shutter(Document& document, float open, float close) {
  document.scene.camera.shutter_open = open;
  document.scene.camera.shutter_close = close;
}

inline Motion translation(vec3 way) {
  Motion m;
  m.translate = way;
  return m;
}
inline Motion rotation(float angle, vec3 axis, vec3 center = vec3(0)) {
  Motion m;
  m.angle = angle, m.axis = axis, m.center = center;
  return m;
}

/// A view straight down the z axis from z = `height`, `extent` scene units high, parallel rays.
inline void look_down(SceneMaker& s, float extent, float height = 5) {
  s.camera({0, 0, height}, {0, 0, 0}, 40);
  s.document.scene.camera.projection = Projection::orthographic;
  s.document.scene.camera.orthographic_height = extent;
}

/// A wavy sheet of triangles over [-1, 1]^2 in the xy plane that turns into another one by time 1.
inline Mesh deforming_sheet(unsigned n) {
  Mesh mesh;
  auto height = [](float x, float y, float phase) { return 0.3f * std::sin(3 * x + y + phase); };
  auto normal = [](float x, float y, float phase) {
    const float slope = 0.3f * std::cos(3 * x + y + phase);
    return glm::normalize(vec3(-3 * slope, -slope, 1));
  };
  for (unsigned i = 0; i <= n; ++i)
    for (unsigned j = 0; j <= n; ++j) {
      const float x = 2 * static_cast<float>(i) / static_cast<float>(n) - 1,
                  y = 2 * static_cast<float>(j) / static_cast<float>(n) - 1;
      mesh.positions.emplace_back(x, y, height(x, y, 0));
      mesh.positions_end.emplace_back(x + 0.2f, 0.8f * y, height(x, y, 2.5f));
      mesh.normals.push_back(normal(x, y, 0));
      mesh.normals_end.push_back(normal(x, y, 2.5f));
      mesh.uvs.emplace_back(0.5f * x + 0.5f, 0.5f * y + 0.5f);
    }
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j) {
      const unsigned a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  return mesh;
}

} // namespace candela::test
