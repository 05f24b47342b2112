// The panel of the scene's textures.

#include "app/panels/panel_list.h"
#include "app/tools/texture_users.h"
#include "app/ui/item_list.h"

namespace candela {

void textures_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.textures", "Textures", false)) return;
  const SceneDesc& scene = state.document.scene;
  if (scene.textures.empty()) {
    ImGui::TextDisabled("The scene has none.");
    ui.record("textures.none");
    return;
  }
  int& selected = state.selected_texture;
  selected = std::clamp(selected, 0, static_cast<int>(scene.textures.size()) - 1);
  item_list(ui, "list.textures", scene.textures.size(), -1, [&](std::size_t i) {
    const int index = static_cast<int>(i);
    if (ui.item(fmt::format("textures/{}", i), texture_label(scene, index).c_str(), index == selected)) {
      selected = index;
      if (state.texture_view.visible) state.texture_view.show(index); // the viewer follows
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
      state.texture_view.show(index);
  });
  const Texture& texture = *scene.textures[static_cast<std::size_t>(selected)];
  if (ui.button("texture.view", "View", "Shows it over the picture; so does a double click", 64 * ui.scale()))
    state.texture_view.show(selected);
  ImGui::SameLine();
  const std::size_t bytes = std::visit([](const auto& kind) { return kind.memory_bytes(); }, texture.model);
  ImGui::TextDisabled("%s%s", texture_summary(texture).c_str(),
                      bytes > 0 ? fmt::format(", {}", bytes_text(bytes)).c_str() : "");
  for (const TextureUser& user : texture_users(scene, selected))
    ImGui::TextDisabled("%s", user.label.c_str());
}

} // namespace candela
