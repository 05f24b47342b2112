#include "app/panels/bookmarks.h"
#include "app/panels/panel_list.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace candela {

std::string free_bookmark_name(const std::vector<Bookmark>& bookmarks, const std::string& wish,
                               std::size_t except) {
  auto taken = [&](const std::string& name) {
    for (std::size_t i = 0; i < bookmarks.size(); ++i)
      if (i != except && bookmarks[i].name == name) return true;
    return false;
  };
  std::string name = wish;
  for (int n = 2; taken(name); ++n) name = fmt::format("{} {}", wish, n);
  return name;
}

void go_to_bookmark(ViewerState& state, std::size_t number) {
  const auto& bookmarks = state.document.scene.bookmarks;
  if (number >= bookmarks.size()) return;
  state.inspect.selected_bookmark = static_cast<int>(number);
  state.inspect.bookmark_name = bookmarks[number].name;
  state.edited |= state.document.scene.camera != bookmarks[number].camera;
  state.document.scene.camera = bookmarks[number].camera;
}

void store_bookmark(ViewerState& state, std::size_t number) {
  auto& bookmarks = state.document.scene.bookmarks;
  if (number >= bookmarks.size()) {
    number = bookmarks.size();
    bookmarks.push_back({free_bookmark_name(bookmarks, fmt::format("View {}", number + 1), number), {}});
  }
  bookmarks[number].camera = state.document.scene.camera;
  state.inspect.selected_bookmark = static_cast<int>(number);
  state.inspect.bookmark_name = bookmarks[number].name;
  state.edited = true;
}

void bookmarks_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.bookmarks", "Bookmarks", false)) return;
  constexpr float kRows = 4; // constant, so that the widgets below do not move
  auto& bookmarks = state.document.scene.bookmarks;
  InspectState& inspect = state.inspect;
  if (ImGui::BeginListBox("##bookmarks", ImVec2(-1, kRows * ImGui::GetTextLineHeightWithSpacing() +
                                                        2 * ImGui::GetStyle().FramePadding.y))) {
    for (std::size_t i = 0; i < bookmarks.size(); ++i) {
      const std::string label = i < 9 ? fmt::format("{}  {}", i + 1, bookmarks[i].name) : bookmarks[i].name;
      if (ui.item(fmt::format("bookmarks/{}", i), label.c_str(),
                  static_cast<int>(i) == inspect.selected_bookmark))
        go_to_bookmark(state, i);
    }
    if (bookmarks.empty()) ImGui::TextDisabled("None yet: fly to a view and add it");
    ImGui::EndListBox();
  }
  const bool any = !bookmarks.empty();
  inspect.selected_bookmark =
      std::clamp(inspect.selected_bookmark, 0, std::max(static_cast<int>(bookmarks.size()) - 1, 0));
  const auto selected = static_cast<std::size_t>(inspect.selected_bookmark);
  const float button = 64 * ui.scale(), gap = ImGui::GetStyle().ItemSpacing.x;
  const bool entered = ui.text("bookmark.name", "Name", inspect.bookmark_name, -button - gap);
  ImGui::SameLine();
  const bool renamed =
      ui.button("bookmark.rename", "Rename", "Gives the selected bookmark this name (Enter)", button);
  if (any && (entered || renamed) && !inspect.bookmark_name.empty() &&
      inspect.bookmark_name != bookmarks[selected].name) {
    bookmarks[selected].name = inspect.bookmark_name =
        free_bookmark_name(bookmarks, inspect.bookmark_name, selected);
    state.edited = true;
  }
  if (ui.button("bookmark.add", "Add view",
                "Adds a bookmark of the current view (Ctrl+1 to Ctrl+9 store, 1 to 9 go there)"))
    store_bookmark(state, bookmarks.size());
  if (!any) return;
  ImGui::SameLine();
  if (ui.button("bookmark.store", "Store here", "Stores the current view in the selected bookmark"))
    store_bookmark(state, selected);
  ImGui::SameLine();
  if (ui.button("bookmark.delete", "Delete", "Removes the selected bookmark")) {
    bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(selected));
    inspect.bookmark_name.clear();
    state.edited = true;
  }
}

} // namespace candela
