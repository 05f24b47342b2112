// Selecting with the mouse, and moving the selection.

#include "app/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

/// Orthonormal, right-handed axes of a transform, for its scale handles.
mat3 axes_of(const mat4& m) {
  const vec3 x(m[0]), y(m[1]);
  if (!(length_squared(glm::cross(x, y)) > 0)) return mat3(1);
  const vec3 z = glm::normalize(glm::cross(x, y)), unit_x = glm::normalize(x);
  return {unit_x, glm::cross(z, unit_x), z};
}

} // namespace

void Viewer::select_at(vec2 mouse) {
  const SceneDesc& scene = state_.document.scene;
  if (const auto light = light_at(mouse)) {
    select({Selection::Kind::light, *light});
    return;
  }
  const auto screen = projection();
  const auto film = screen ? screen->film_position(mouse) : std::nullopt;
  if (!film) return; // outside the film
  const std::optional<Pick> found = session_->pick(*film);
  if (!found) {
    select({});
    return;
  }
  select({Selection::Kind::object, found->instance});
  if (found->material >= 0 && static_cast<std::size_t>(found->material) < scene.materials.size())
    state_.selected_material = found->material;
}

void Viewer::select(const Selection& selection) {
  const SceneDesc& scene = state_.document.scene;
  state_.selection = checked_selection(scene, selection);
  state_.reveal_selection = true;
  if (state_.selection.kind == Selection::Kind::object) {
    state_.selected_material =
        scene.instances[static_cast<std::size_t>(state_.selection.index)].materials.front();
    session_->expect_moves();
  }
  if (const auto row = light_row(scene, state_.home.scene, state_.selection)) state_.selected_light = *row;
}

std::optional<Gizmo> Viewer::present_gizmo() {
  if (state_.tool == Tool::select) return std::nullopt;
  const Selection& selected = state_.selection;
  const bool light = selected.kind == Selection::Kind::light;
  if (light && state_.tool != Tool::move) return std::nullopt; // rotating or scaling a point has no effect
  const auto corners = selection_box_.corners(state_.document.scene, selected);
  if (!corners) return std::nullopt;
  Gizmo gizmo{state_.tool, bounds_of(*corners).center(), mat3(1), state_.scale};
  if (state_.tool == Tool::scale) {
    const auto& instance = state_.document.scene.instances[static_cast<std::size_t>(selected.index)];
    gizmo.axes = axes_of(instance.world_from_object);
  }
  return gizmo;
}

bool Viewer::begin_gizmo_drag(vec2 mouse) {
  const auto gizmo = present_gizmo();
  const auto screen = projection();
  if (!gizmo || !screen) return false;
  const auto handle = gizmo->hit(*screen, mouse);
  if (!handle) return false;
  gizmo_drag_.emplace(*gizmo, *handle, mouse);
  before_drag_ = state_.document;
  return true;
}

void Viewer::drag_gizmo(vec2 mouse) {
  const auto screen = projection();
  if (!screen || !gizmo_drag_) return;
  const mat4 moved = gizmo_drag_->moved_to(*screen, mouse, ImGui::GetIO().KeyCtrl);
  const auto index = static_cast<std::size_t>(state_.selection.index);
  SceneDesc& scene = state_.document.scene;
  if (state_.selection.kind == Selection::Kind::light) {
    if (vec3* position = light_position(scene.lights[index]))
      *position = transform_point(moved, *light_position(before_drag_.scene.lights[index]));
  } else {
    const mat4 placed = moved * before_drag_.scene.instances[index].world_from_object;
    for (int c = 0; c < 4; ++c)
      if (!is_finite(vec3(placed[c]))) return;
    scene.instances[index].world_from_object = placed;
  }
  state_.edited = true;
}

/// Reverts the current drag.
void Viewer::cancel_gesture() {
  if (gesture_ == Gesture::gizmo) {
    state_.document.scene.instances = before_drag_.scene.instances;
    state_.document.scene.lights = before_drag_.scene.lights;
    state_.edited = true;
  }
  gizmo_drag_.reset();
  gesture_ = Gesture::none;
}

} // namespace candela
