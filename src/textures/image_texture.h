#pragma once

#include "imaging/texels.h"
#include "textures/mip_pyramid.h"
#include "textures/texture_kind.h"

#include <memory>
#include <string>

namespace candela {

/// A picture. v = 0 is its bottom row, as in OBJ.
struct ImageTexture {
  static constexpr std::string_view kName = "image";
  static std::span<const Field<ImageTexture>> rows() { return {}; }

  std::string source; ///< the file that it came from; empty: none
  std::shared_ptr<const Texels> texels = std::make_shared<const Texels>();

  /// By content.
  bool operator==(const ImageTexture& other) const {
    return source == other.source && (texels == other.texels || *texels == *other.texels);
  }

  /// Decoded before they are blended, for light adds linearly.
  vec3 color(const TextureUse& use, vec2 uv) const;
  float number(const TextureUse& use, vec2 uv) const;
  /// About the mean over the footprint; `pyramid` is of these texels in the use's colour space.
  vec4 filtered(const TextureUse& use, const TexturePoint& at, const MipPyramid& pyramid) const;
  vec2 cells() const { return {static_cast<float>(texels->width), static_cast<float>(texels->height)}; }
  std::size_t memory_bytes() const { return texels->bytes(); }
};

} // namespace candela
