#pragma once
// A list box that draws only its visible rows: a scene may have ten thousand objects.

#include "app/ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace candela {

/// "Material 3" for one without a name.
inline std::string name_or_number(const std::string& name, std::string_view kind, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

/// `row(i)` draws row i, which is `height` high (0: a line of text). Scrolls to `reveal` unless it is
/// negative.
template <class Row>
void item_list(Ui& ui, const char* name, std::size_t count, int reveal, Row row, float height = 0) {
  constexpr std::size_t kRows = 6;
  const auto rows = static_cast<float>(std::clamp<std::size_t>(count, 1, kRows));
  const float line =
      height > 0 ? height + ImGui::GetStyle().ItemSpacing.y : ImGui::GetTextLineHeightWithSpacing();
  const std::string id = fmt::format("##{}", name);
  if (!ImGui::BeginListBox(id.c_str(), ImVec2(-1, rows * line + 2 * ImGui::GetStyle().FramePadding.y))) {
    ui.record(name); // scrolled away
    return;
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(count), line);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) row(static_cast<std::size_t>(i));
  if (reveal >= 0) {
    const float top = line * static_cast<float>(reveal), shown = ImGui::GetScrollY();
    if (top < shown || top + line > shown + rows * line)
      ImGui::SetScrollY(std::max(0.0f, top - 0.5f * (rows - 1) * line));
  }
  ImGui::EndListBox();
  ui.record(name);
}

} // namespace candela
