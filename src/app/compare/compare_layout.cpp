#include "app/compare/compare_layout.h"

#include <algorithm>

namespace candela {

namespace {

PixelRect zoomed(const PixelRect& region, ivec2 shape, int zoom, vec2 pan) {
  PixelRect rect = centered(region, zoom * shape);
  rect.x -= static_cast<int>(std::lround(static_cast<float>(zoom) * pan.x));
  rect.y -= static_cast<int>(std::lround(static_cast<float>(zoom) * pan.y));
  return rect;
}

} // namespace

int ComparePanes::variant_at(vec2 position) const {
  const Pane& b = variants[1];
  const bool inside =
      position.x >= static_cast<float>(b.clip.x) && position.x < static_cast<float>(b.clip.x + b.clip.width);
  return b.shown && inside ? 1 : 0;
}

ComparePanes compare_panes(const CompareState& state, const PixelRect& region, const PixelRect& whole,
                           ivec2 shape) {
  ComparePanes panes;
  auto place = [&](const PixelRect& room, const PixelRect& fitted) {
    return state.zoom > 0 ? zoomed(room, shape, state.zoom, state.pan) : fitted;
  };
  if (state.layout == CompareLayout::side_by_side) {
    constexpr int kGap = 2;
    const int half = std::max((region.width - kGap) / 2, 1);
    const PixelRect rooms[] = {{region.x, region.y, half, region.height},
                               {region.x + half + kGap, region.y, half, region.height}};
    for (std::size_t i = 0; i < 2; ++i)
      panes.variants[i] = {true, place(rooms[i], letterbox(rooms[i], shape)), rooms[i]};
    return panes;
  }
  const PixelRect picture = place(region, whole);
  panes.variants = {{{true, picture, region}, {true, picture, region}}};
  switch (state.layout) {
  case CompareLayout::side_by_side: break;
  case CompareLayout::wipe: {
    const int left = std::clamp(
        static_cast<int>(std::lround(state.divider * static_cast<float>(region.width))), 0, region.width);
    panes.divider = region.x + left;
    panes.variants[0].clip.width = left;
    panes.variants[1].clip.x += left;
    panes.variants[1].clip.width -= left;
    break;
  }
  case CompareLayout::flip: panes.variants[state.flipped ? 0 : 1].shown = false; break;
  case CompareLayout::difference:
    panes.difference = true;
    panes.variants[1].shown = false;
    break;
  }
  return panes;
}

} // namespace candela
