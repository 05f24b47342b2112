// Overlays of the picture: the selection's box, lights, the gizmo, the region.

#include "app/ui/imgui_vec.h"
#include "app/viewer/viewer.h"

#include <imgui.h>

namespace candela {

namespace {

constexpr float kLightRadius = 8; // of an icon, at scale 1
constexpr ImU32 kSelected = IM_COL32(255, 170, 60, 255), kLightColor = IM_COL32(245, 235, 200, 235),
                kShadow = IM_COL32(0, 0, 0, 120), kRegionColor = IM_COL32(230, 90, 70, 255);

void shadowed_line(ImDrawList& list, vec2 a, vec2 b, ImU32 color, float width) {
  list.AddLine(im(a), im(b), kShadow, width + 2);
  list.AddLine(im(a), im(b), color, width);
}

void shadowed_text(ImDrawList& list, vec2 at, const std::string& text) {
  list.AddText(im(at + 1.0f), IM_COL32(0, 0, 0, 200), text.c_str());
  list.AddText(im(at), kSelected, text.c_str());
}

/// A lamp: a disc with rays.
void draw_light(ImDrawList& list, vec2 at, bool selected, float unit) {
  const ImU32 color = selected ? kSelected : kLightColor;
  list.AddCircleFilled(im(at), 5.5f * unit, kShadow);
  list.AddCircleFilled(im(at), 4 * unit, color);
  for (int i = 0; i < 8; ++i) {
    const float angle = 0.25f * kPi * static_cast<float>(i);
    const vec2 d(std::cos(angle), std::sin(angle));
    shadowed_line(list, at + 6.5f * unit * d, at + 10 * unit * d, color, 1.3f * unit);
  }
}

} // namespace

/// Hidden panels also hide the overlays.
bool Viewer::shows_overlays() const { return state_.overlays_visible && shows_panels(); }

void Viewer::draw_overlay() {
  const auto screen = projection();
  if (!screen) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const PixelRect free = free_region();
  list.PushClipRect(im(vec2(free.x, free.y)), im(vec2(free.x + free.width, free.y + free.height)));
  if (shows_overlays()) {
    draw_selection(*screen, list);
    for (const LightIcon& light : light_icons(*screen))
      draw_light(list, light.position, state_.selection == Selection{Selection::Kind::light, light.index},
                 state_.scale);
  }
  if (const auto gizmo = present_gizmo()) {
    std::optional<GizmoHandle> handle = gizmo_drag_ ? std::optional(gizmo_drag_->handle()) : std::nullopt;
    const ImGuiIO& io = ImGui::GetIO();
    if (!handle && gesture_ == Gesture::none && !io.WantCaptureMouse)
      handle = gizmo->hit(*screen, {io.MousePos.x, io.MousePos.y});
    gizmo->draw(*screen, list, handle);
  }
  draw_region(list);
  list.PopClipRect();
}

void Viewer::draw_selection(const ScreenProjection& screen, ImDrawList& list) {
  const auto corners = selection_box_.corners(state_.document.scene, state_.selection);
  if (!corners) return;
  const bool point = state_.selection.kind == Selection::Kind::light;
  std::optional<vec2> highest;
  for (std::size_t i = 0; i < corners->size(); ++i) {
    if (const auto at = screen.point((*corners)[i]); at && (!highest || at->y < highest->y)) highest = at;
    for (std::size_t bit : {1u, 2u, 4u}) {
      if ((i & bit) != 0 || point) continue;
      if (const auto edge = screen.segment((*corners)[i], (*corners)[i | bit]))
        shadowed_line(list, edge->first, edge->second, kSelected, 1.2f * state_.scale);
    }
  }
  if (!highest) return;
  const std::string name = selection_name(state_.document.scene, state_.selection);
  const ImVec2 size = ImGui::CalcTextSize(name.c_str());
  const PixelRect free = free_region();
  const vec2 margin(4 * state_.scale);
  vec2 at = *highest - vec2(0.5f * size.x, size.y + (point ? 14 : 6) * state_.scale);
  at = glm::min(at, vec2(free.x + free.width, free.y + free.height) - vec2(size.x, size.y) - margin);
  shadowed_text(list, glm::max(at, vec2(free.x, free.y) + margin), name);
}

void Viewer::draw_region(ImDrawList& list) const {
  const PixelRect picture = picture_rect();
  const vec2 origin(picture.x, picture.y), size(picture.width, picture.height);
  if (gesture_ == Gesture::region && dragged_)
    list.AddRect(im(press_position_), im(drag_position_), kRegionColor, 0, 0, 1.5f * state_.scale);
  else if (state_.region)
    list.AddRect(im(origin + size * state_.region->lo), im(origin + size * state_.region->hi), kRegionColor,
                 0, 0, 1.5f * state_.scale);
}

std::vector<Viewer::LightIcon> Viewer::light_icons(const ScreenProjection& screen) const {
  std::vector<LightIcon> icons;
  const auto& lights = state_.document.scene.lights;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (const vec3* position = light_position(lights[i]))
      if (const auto at = screen.point(*position)) icons.push_back({static_cast<int>(i), *at});
  return icons;
}

std::optional<int> Viewer::light_at(vec2 mouse) const {
  const auto screen = projection();
  if (!screen || !shows_overlays()) return std::nullopt;
  std::optional<int> found;
  float nearest = kLightRadius * state_.scale;
  for (const LightIcon& light : light_icons(*screen))
    if (const float distance = glm::length(light.position - mouse); distance <= nearest)
      nearest = distance, found = light.index;
  return found;
}

} // namespace candela
