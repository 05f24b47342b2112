#include "app/panels/material_picker.h"

#include "app/ui/item_list.h"
#include "materials/material_parts.h"

#include <algorithm>
#include <utility>

namespace candela {

void draw_material_thumbnail(ViewerState& state, std::size_t material, vec2 lo, vec2 hi) {
  ThumbnailState& thumbnails = state.thumbnails;
  thumbnails.drawn.insert(material);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const unsigned texture = material < thumbnails.textures.size() ? thumbnails.textures[material] : 0;
  if (texture == 0) {
    list.AddRect({lo.x, lo.y}, {hi.x, hi.y}, ImGui::GetColorU32(ImGuiCol_Border));
    if (material < thumbnails.problems.size() && !thumbnails.problems[material].empty()) {
      const vec2 mark = 0.5f * (lo + hi) - 0.5f * vec2(ImGui::CalcTextSize("!").x, ImGui::GetFontSize());
      list.AddText({mark.x, mark.y}, ImGui::GetColorU32(ImGuiCol_Text), "!");
      if (ImGui::IsMouseHoveringRect({lo.x, lo.y}, {hi.x, hi.y}))
        ImGui::SetTooltip("No picture of this material:\n%s", thumbnails.problems[material].c_str());
    }
  } else {
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), {lo.x, lo.y},
                  {hi.x, hi.y});
  }
}

void material_part_field(Ui& ui, ViewerState& state, std::size_t material, const MaterialField& row) {
  auto& materials = state.document.scene.materials;
  int& part = *static_cast<int*>(row.address(materials[material]));
  std::vector<std::string> names = {"none"};
  std::vector<int> indices = {-1};
  for (int i = 0; i < static_cast<int>(materials.size()); ++i) {
    const Material& other = materials[static_cast<std::size_t>(i)];
    if (is_null(other) || contains_material(materials, i, static_cast<int>(material))) continue;
    names.push_back(name_or_number(other.name, "Material", static_cast<std::size_t>(i)));
    indices.push_back(i);
  }
  const std::vector<std::string_view> choices(names.begin(), names.end());
  auto chosen = static_cast<int>(std::ranges::find(indices, part) - indices.begin());
  const std::string name = fmt::format("material.{}", row.key), label = field_label(row);
  auto picture = [&](std::size_t i, vec2 lo, vec2 hi) {
    if (indices[i] >= 0) draw_material_thumbnail(state, static_cast<std::size_t>(indices[i]), lo, hi);
  };
  if (!ui.choice(name.c_str(), label.c_str(), chosen, choices, field_tooltip(row, nullptr), picture)) return;
  const int before = std::exchange(part, indices[static_cast<std::size_t>(chosen)]);
  if (const auto problem = parts_problem(materials)) {
    part = before;
    state.fail(ErrorCause::material, fmt::format("{}: {}", problem->cause, problem->remedy));
    return;
  }
  state.settle(ErrorCause::material);
  state.edited = true;
}

} // namespace candela
