#include "app/tools/selection.h"

#include "io/builder/scene_builder.h"

#include <fmt/format.h>

namespace candela {

Selection checked_selection(const SceneDesc& scene, const Selection& selection) {
  std::size_t count = 0;
  if (selection.kind == Selection::Kind::object) count = scene.instances.size();
  if (selection.kind == Selection::Kind::light) count = scene.lights.size();
  const bool exists = selection.index >= 0 && static_cast<std::size_t>(selection.index) < count;
  return exists ? selection : Selection{};
}

std::string selection_name(const SceneDesc& scene, const Selection& selection) {
  const auto index = static_cast<std::size_t>(selection.index);
  auto name = [&](const std::string& given, const char* kind) {
    return given.empty() ? fmt::format("{} {}", kind, index) : given;
  };
  switch (selection.kind) {
  case Selection::Kind::none: break;
  case Selection::Kind::object: return name(scene.instances[index].name, "Object");
  case Selection::Kind::light: return name(scene.lights[index].name, "Light");
  }
  return {};
}

std::vector<std::size_t> shining_materials(const SceneDesc& scene, const SceneDesc& home) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const bool shone = i < home.materials.size() && !is_black(home.materials[i].emission.value);
    if (shone || !is_black(scene.materials[i].emission.value)) found.push_back(i);
  }
  return found;
}

std::optional<int> light_row(const SceneDesc& scene, const SceneDesc& home, const Selection& selection) {
  if (selection.kind == Selection::Kind::light) return selection.index;
  if (selection.kind == Selection::Kind::none) return std::nullopt;
  const std::vector<std::size_t> shining = shining_materials(scene, home);
  for (int material : scene.instances[static_cast<std::size_t>(selection.index)].materials)
    for (std::size_t i = 0; i < shining.size(); ++i)
      if (shining[i] == static_cast<std::size_t>(material)) return static_cast<int>(scene.lights.size() + i);
  return std::nullopt;
}

Bounds3 SelectionBox::box(const Instance& instance) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
  if (mesh == nullptr) return object_bounds(instance.shape);
  if (mesh_ != *mesh) mesh_ = *mesh, mesh_bounds_ = object_bounds(instance.shape);
  return mesh_bounds_;
}

vec3 SelectionBox::middle(const SceneDesc& scene, const Selection& selection) {
  if (selection.kind != Selection::Kind::object) return vec3(0);
  const Bounds3 bounds = box(scene.instances[static_cast<std::size_t>(selection.index)]);
  return bounds.empty() ? vec3(0) : bounds.center();
}

std::optional<BoxCorners> SelectionBox::corners(const SceneDesc& scene, const Selection& selection) {
  BoxCorners corners;
  const auto index = static_cast<std::size_t>(selection.index);
  if (selection.kind == Selection::Kind::light) {
    const vec3* position = light_position(scene.lights[index]);
    if (position == nullptr) return std::nullopt;
    corners.fill(*position);
    return corners;
  }
  if (selection.kind == Selection::Kind::none) return std::nullopt;
  const Instance& instance = scene.instances[index];
  const Bounds3 box = this->box(instance);
  if (box.empty()) return std::nullopt;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = transform_point(instance.world_from_object,
                                 {(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                                  (i & 4) != 0 ? box.hi.z : box.lo.z});
  return corners;
}

Bounds3 bounds_of(const BoxCorners& corners) {
  Bounds3 bounds;
  for (vec3 corner : corners) bounds.grow(corner);
  return bounds;
}

} // namespace candela
