#pragma once
// Pictures for textures, in the precision of their files.

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
  /// Integers represent [0, 1]; the texture lookup decodes them. Floats are linear.
  using Data = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>>;
  Data data;
  bool operator==(const Texels&) const = default;

  std::size_t texel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t bytes() const;
};

/// Removes an alpha that is 1 everywhere, and reduces grey texels to one channel; lookups do not change.
Texels with_fewest_channels(Texels texels);

/// A problem of the texels ("its pixels do not fit its size"); empty if they are valid.
const char* texels_problem(const Texels& texels);

/// Texels for display: three sRGB bytes each. Integers are assumed to be sRGB; floats are encoded and clipped
/// to [0, 1]. Alpha is dropped.
std::vector<std::uint8_t> srgb8_texels(const Texels& texels);

} // namespace candela
