#include "imaging/color_map.h"

namespace candela {

namespace {

using Color = std::array<std::uint8_t, 3>;

constexpr std::array<Color, 9> kMagma = {Color{0, 0, 4},      Color{29, 17, 71},    Color{81, 18, 124},
                                         Color{130, 38, 129}, Color{182, 54, 121},  Color{230, 81, 100},
                                         Color{251, 136, 97}, Color{254, 194, 135}, Color{252, 253, 191}};
constexpr std::array<Color, 9> kViridis = {Color{68, 1, 84},    Color{71, 45, 123},  Color{59, 82, 139},
                                           Color{44, 114, 142}, Color{33, 144, 140}, Color{39, 173, 129},
                                           Color{93, 200, 99},  Color{170, 220, 50}, Color{253, 231, 37}};

} // namespace

Color map_color(ColorMap map, float t) {
  const auto& colors = map == ColorMap::magma ? kMagma : kViridis;
  t = t > 0 ? (t < 1 ? t : 1) : 0;
  constexpr std::size_t kLast = kMagma.size() - 1;
  float at = t * static_cast<float>(kLast);
  std::size_t i = at < static_cast<float>(kLast) ? static_cast<std::size_t>(at) : kLast - 1;
  float fraction = at - static_cast<float>(i);
  Color out;
  for (std::size_t c = 0; c < 3; ++c) {
    float low = static_cast<float>(colors[i][c]), high = static_cast<float>(colors[i + 1][c]);
    out[c] = static_cast<std::uint8_t>(low + (high - low) * fraction + 0.5f);
  }
  return out;
}

} // namespace candela
