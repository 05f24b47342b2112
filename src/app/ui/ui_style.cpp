#include "app/ui/ui_style.h"

#include "app/figures/typeface.h"
#include "core/error.h"

#include <imgui.h>

#include <cmath>
#include <deque>

namespace candela {

namespace {

constexpr float kTextSize = 15; // pixels at scale 1

// Latin, Greek and Cyrillic for file and material names, dashes, bullets and the ellipsis.
constexpr ImWchar kGlyphs[] = {0x20, 0x24f, 0x370, 0x52f, 0x2010, 0x2027, 0x2030, 0x203a, 0x2212, 0x2212, 0};

ImVec4 grey(float value, float alpha = 1) { return {value, value, value, alpha}; }

/// Merges the glyphs of the other scripts' typefaces into the last font, and builds the atlas.
void merge_fallbacks(ImFontAtlas& atlas, float size, std::set<char32_t> wanted) {
  std::deque<ImVector<ImWchar>> ranges; // the atlas keeps pointers to them until it is built
  for (const std::filesystem::path& file : find_fallback_typefaces()) {
    if (wanted.empty()) break;
    ImFontGlyphRangesBuilder builder;
    try {
      const Typeface typeface(file);
      std::erase_if(wanted, [&](char32_t c) {
        const bool there = typeface.has(c);
        if (there) builder.AddChar(static_cast<ImWchar>(c));
        return there;
      });
    } catch (const Error&) { continue; } // a broken file: try the others
    builder.BuildRanges(&ranges.emplace_back());
    if (ranges.back().Size < 3) continue; // no glyph of this typeface
    ImFontConfig config;
    config.MergeMode = true;
    config.PixelSnapH = true;
    config.OversampleH = config.OversampleV = 1;
    atlas.AddFontFromFileTTF(file.c_str(), size, &config, ranges.back().Data);
  }
  atlas.Build();
}

} // namespace

bool is_common_glyph(char32_t code_point) {
  for (const ImWchar* range = kGlyphs; *range != 0; range += 2)
    if (code_point >= range[0] && code_point <= range[1]) return true;
  return code_point < 0x20;
}

UiFonts load_fonts(ImFontAtlas& atlas, float scale, const std::set<char32_t>& more) {
  ImFontConfig config;
  config.OversampleH = scale < 1.5f ? 3 : 2;
  config.OversampleV = 1;
  config.PixelSnapH = true; // so that equal advances stay equal
  const float size = std::round(kTextSize * scale);
  if (const std::filesystem::path file = find_typeface(); !file.empty())
    if (ImFont* font = atlas.AddFontFromFileTTF(file.c_str(), size, &config, kGlyphs)) {
      merge_fallbacks(atlas, size, more);
      return {font, true};
    }
  ImFontConfig fallback;
  fallback.SizePixels = std::round(13 * scale);
  ImFont* font = atlas.AddFontDefault(&fallback);
  merge_fallbacks(atlas, fallback.SizePixels, more);
  return {font, false};
}

void apply_style(float scale) {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 2;
  style.PopupRounding = 4;
  style.ScrollbarRounding = 4;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowPadding = {12, 8};
  style.FramePadding = {6, 3};
  style.ItemSpacing = {6, 4};
  style.ItemInnerSpacing = {4, 4};
  style.ScrollbarSize = 11;
  style.GrabMinSize = 9;
  style.ButtonTextAlign = {0.5f, 0.5f};
  style.ScaleAllSizes(scale);

  auto* colors = style.Colors;
  const ImVec4 accent(0.85f, 0.62f, 0.30f, 1); // candlelight; for marks only, not for areas
  colors[ImGuiCol_Text] = grey(0.87f);
  colors[ImGuiCol_TextDisabled] = grey(0.56f);
  colors[ImGuiCol_WindowBg] = grey(kPanelGrey);
  colors[ImGuiCol_ChildBg] = grey(0, 0);
  colors[ImGuiCol_PopupBg] = grey(0.17f, 0.99f);
  colors[ImGuiCol_Border] = grey(0.30f);
  colors[ImGuiCol_FrameBg] = grey(0.21f);
  colors[ImGuiCol_FrameBgHovered] = grey(0.26f);
  colors[ImGuiCol_FrameBgActive] = grey(0.29f);
  colors[ImGuiCol_ScrollbarBg] = grey(kPanelGrey);
  colors[ImGuiCol_ScrollbarGrab] = grey(0.30f);
  colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.38f);
  colors[ImGuiCol_ScrollbarGrabActive] = grey(0.45f);
  colors[ImGuiCol_CheckMark] = accent;
  colors[ImGuiCol_SliderGrab] = grey(0.40f); // dark enough for the number over it
  colors[ImGuiCol_SliderGrabActive] = ImVec4(0.60f, 0.43f, 0.20f, 1);
  colors[ImGuiCol_Button] = grey(0.25f);
  colors[ImGuiCol_ButtonHovered] = grey(0.32f);
  colors[ImGuiCol_ButtonActive] = grey(0.38f);
  colors[ImGuiCol_Header] = grey(0.205f);
  colors[ImGuiCol_HeaderHovered] = grey(0.27f);
  colors[ImGuiCol_HeaderActive] = grey(0.31f);
  colors[ImGuiCol_Separator] = grey(0.26f);
  colors[ImGuiCol_PlotHistogram] = grey(0.46f);
  colors[ImGuiCol_TextSelectedBg] = ImVec4(0.85f, 0.62f, 0.30f, 0.35f);
  ImGui::GetStyle() = style;
}

} // namespace candela
