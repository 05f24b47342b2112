#pragma once
// Small textures.

#include "textures/texture.h"

namespace candela::test {

/// A picture of 8 bits a channel; rows from the top.
inline std::shared_ptr<const Texture> picture_texture(int width, int height, std::vector<std::uint8_t> values,
                                                      int channels = 3) {
  auto texels = std::make_shared<const Texels>(Texels{width, height, channels, std::move(values)});
  return std::make_shared<const Texture>(Texture{"", ImageTexture{"", std::move(texels)}});
}

} // namespace candela::test
