#pragma once
// The style: a scalable typeface from Debian's packages and neutral dark colours, scaled for the monitor.

#include <set>

struct ImFontAtlas;
struct ImFont;

namespace candela {

/// Grey of the empty window, sRGB; neutral, because a coloured surround distorts perceived colours.
inline constexpr float kBackgroundGrey = 0.11f;
inline constexpr float kPanelGrey = 0.145f; ///< background of the panels

struct UiFonts {
  ImFont* regular = nullptr;
  bool scalable = false; ///< false: none of the typefaces is installed, ImGui's own is used
};

/// Fills an empty atlas for the scale (1: 96 dots per inch). Uses the first installed typeface with digits of
/// equal width, so that changing numbers do not jitter. It has the letters of Europe; those of other scripts
/// (`more`) come from other installed typefaces.
UiFonts load_fonts(ImFontAtlas& atlas, float scale, const std::set<char32_t>& more = {});

/// Whether every atlas has the character, or it is invisible.
bool is_common_glyph(char32_t code_point);

/// Sets the current ImGui context's style for the scale.
void apply_style(float scale);

} // namespace candela
