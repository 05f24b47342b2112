#pragma once
// A texture as a grid of values, and parts of the grid as pixels for a screen: what a viewer of textures
// shows.

#include "core/progress.h"
#include "textures/texture.h"

#include <array>
#include <cstdint>

namespace candela {

/// How a material's parameter looks at a texture: factor * texel + offset, clamped.
struct ParameterLook {
  TextureUse use;
  bool is_number = false; ///< the factor and offset are x
  vec3 factor{1}, offset{0};
  float lowest = -kInfinity, highest = kInfinity;
  bool operator==(const ParameterLook&) const = default;
};

struct TextureGridOptions {
  std::optional<ParameterLook> look; ///< nothing: the texture itself
  int copies = 1;                    ///< the grid covers [0, copies]^2 of the coordinates
  // Of the texture itself:
  TextureWrap wrap = TextureWrap::repeat; ///< outside of [0, 1]^2
  ColorSpace color_space = ColorSpace::srgb;
  int level = 0; ///< of a picture's pyramid; 0: the picture
  // Of patterns:
  int resolution = 512; ///< values along one unit
  bool operator==(const TextureGridOptions&) const = default;
};

/// A texel as it is in the file: its integers or floats.
struct StoredTexel {
  int channels = 0;
  bool integer = false;
  std::array<float, 4> values{};
};

/// Row 0 is the top, as of pictures; v grows upwards. Any thread may read one.
class TextureGrid {
public:
  /// `pyramid` is of the texture's texels and the options' colour space; a level above 0 needs it.
  TextureGrid(std::shared_ptr<const Texture> texture, const TextureGridOptions& options,
              std::shared_ptr<const MipPyramid> pyramid = nullptr);

  const std::shared_ptr<const Texture>& texture() const { return texture_; }
  const TextureGridOptions& options() const { return options_; }
  /// Columns and rows, of all copies.
  ivec2 size() const { return options_.copies * unit_; }
  /// Of one copy.
  ivec2 unit_size() const { return unit_; }
  /// Coordinates of a value's middle.
  vec2 uv(ivec2 at) const;
  /// Red, green, blue, alpha, linear: of the texture itself, or of the parameter's value.
  vec4 value(ivec2 at) const;
  /// Of a picture itself; nothing of patterns, of parameters and of other levels.
  std::optional<StoredTexel> stored(ivec2 at) const;
  /// Whether the values are integers of a picture without an encoding. They are shown as a screen shows
  /// these integers: a normal map is blue, as in every other program.
  bool holds_codes() const;

private:
  ivec2 wrapped(ivec2 at) const;

  std::shared_ptr<const Texture> texture_;
  TextureGridOptions options_;
  std::shared_ptr<const MipPyramid> pyramid_;
  ivec2 unit_{1};
};

enum class ShownChannel : int { rgb, red, green, blue, alpha };

struct TextureDisplay {
  ShownChannel channel = ShownChannel::rgb; ///< one alone is grey; alpha is shown as stored
  float exposure = 0;                       ///< stops; not of alpha
  bool operator==(const TextureDisplay&) const = default;
};

/// The size of a grid reduced by 2^reduction, rounded up.
ivec2 reduced_size(ivec2 size, int reduction);

/// Pixels of the reduced grid from `origin` on, four bytes each (sRGB; alpha is 255), row by row. A pixel is
/// the mean of the values that it covers, of at most 4 x 4 of them, evenly spread. NaN is black. Throws
/// Cancelled soon after `progress` is told to end; it may be null.
std::vector<std::uint8_t> grid_pixels(const TextureGrid& grid, const TextureDisplay& display, int reduction,
                                      ivec2 origin, ivec2 size, const Progress* progress = nullptr);

} // namespace candela
