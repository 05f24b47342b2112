#pragma once
// Looks: a scalable typeface from Debian's packages and a neutral dark style, both sized by the monitor.

#include <set>

struct ImFontAtlas;
struct ImFont;

namespace candela {

/// Grey of the empty window, sRGB; neutral, because a coloured frame lies about colours.
inline constexpr float kBackgroundGrey = 0.11f;
inline constexpr float kPanelGrey = 0.145f; ///< the ground of panels

struct UiFonts {
  ImFont* regular = nullptr;
  bool scalable = false; ///< false: none of the typefaces is installed, ImGui's own stands in
};

/// Fills an empty atlas for the scale (1: 96 dots an inch). The first installed typeface whose digits are all
/// equally wide is taken, so that running numbers stand still. It has the letters of Europe; those of other
/// scripts (`more`) come from the typefaces that have them, as far as such are installed.
UiFonts load_fonts(ImFontAtlas& atlas, float scale, const std::set<char32_t>& more = {});

/// Whether every atlas has it, or nothing is drawn for it.
bool is_common_glyph(char32_t code_point);

/// Sets the current ImGui context's style for the scale.
void apply_style(float scale);

} // namespace candela
