#pragma once
// Windows of Dear ImGui that are fixed parts of ours.

#include "app/ui/imgui_vec.h"

namespace candela {

/// ImGui::Begin, at a place in framebuffer pixels, without a title and unmovable.
inline bool begin_pane(const char* name, vec2 position, vec2 size, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(im(position));
  ImGui::SetNextWindowSize(im(glm::max(size, 1.0f)));
  return ImGui::Begin(name, nullptr,
                      flags | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                          ImGuiWindowFlags_NoBringToFrontOnFocus);
}

} // namespace candela
