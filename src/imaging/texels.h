#pragma once
// Pictures as textures keep them: in the precision of their files.

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace candela {

/// Rows from the top, channels interleaved: 1 (grey), 3 (red, green, blue) or 4 (and alpha).
struct Texels {
  int width = 0;
  int height = 0;
  int channels = 3;
  /// Integers stand for [0, 1]; how they are decoded is up to who looks them up. Floats are linear.
  using Data = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>>;
  Data data;
  bool operator==(const Texels&) const = default;

  std::size_t texel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t bytes() const;
};

/// Without an alpha that is 1 everywhere, and with one channel where all texels are grey: what is looked up
/// stays the same.
Texels with_fewest_channels(Texels texels);

/// What is wrong with their size ("its pixels do not fit its size"); empty where all is well.
const char* texels_problem(const Texels& texels);

/// As shown on a screen: three sRGB bytes a texel. Integers are taken for sRGB; floats are encoded and
/// clipped to [0, 1]. Alpha is dropped.
std::vector<std::uint8_t> srgb8_texels(const Texels& texels);

} // namespace candela
