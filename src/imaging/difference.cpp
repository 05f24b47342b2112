#include "imaging/difference.h"

#include "imaging/compare.h"

#include <cassert>

namespace candela {

double relative_difference(vec3 x, vec3 r) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double reference = static_cast<double>(r[c]);
    sum += (static_cast<double>(x[c]) - reference) / std::sqrt(reference * reference + 0.01);
  }
  return sum / 3;
}

std::array<std::uint8_t, 3> map_signed_color(float t) {
  using Color = std::array<float, 3>;
  // Both ends are equally light; lightness increases with the distance from 0.
  constexpr Color kStops[2][3] = {{{22, 22, 22}, {20, 96, 190}, {150, 215, 255}},
                                  {{22, 22, 22}, {188, 84, 10}, {255, 214, 140}}};
  const Color* stops = kStops[t > 0 ? 1 : 0];
  const float at = 2 * (std::abs(t) < 1 ? std::abs(t) : std::isnan(t) ? 0.0f : 1.0f);
  const std::size_t i = at < 1 ? 0 : 1;
  std::array<std::uint8_t, 3> out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(stops[i][c] +
                                       (stops[i + 1][c] - stops[i][c]) * (at - static_cast<float>(i)) + 0.5f);
  return out;
}

std::vector<std::uint8_t> difference_rgba8(std::span<const vec3> image, std::span<const vec3> reference,
                                           bool with_sign, float range) {
  assert(image.size() == reference.size());
  constexpr std::array<std::uint8_t, 3> kNonFinite = {0, 255, 255};
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * image.size());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const vec3 x = image[i], r = reference[i];
    std::array<std::uint8_t, 3> color = kNonFinite;
    if (is_finite(x) && is_finite(r)) {
      color = with_sign
                  ? map_signed_color(static_cast<float>(relative_difference(x, r)) / range)
                  : map_color(ColorMap::magma,
                              (static_cast<float>(std::log10(std::max(relative_error(x, r), 1e-3))) + 3) / 3);
    }
    rgba.insert(rgba.end(), {color[0], color[1], color[2], 255});
  }
  return rgba;
}

} // namespace candela
