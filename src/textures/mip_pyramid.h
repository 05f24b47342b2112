#pragma once
// A picture in ever smaller sizes, so that what is far away is looked up once rather than texel by texel
// (Williams 1983, "Pyramidal Parametrics").

#include "core/progress.h"
#include "imaging/texels.h"
#include "textures/texture_use.h"

#include <memory>
#include <span>
#include <vector>

namespace candela {

class MipPyramid {
public:
  /// Linear values, channels as of the picture.
  struct Level {
    int width = 0, height = 0;
    std::vector<float> values;
  };

  /// Each level has half the width and height of the one before, rounded down, down to a single texel: of
  /// each texel the mean of what it covers, so that all levels have the mean of the picture. Alpha is
  /// averaged like a colour. Throws Cancelled soon after `progress` is told to end; it may be null.
  MipPyramid(std::shared_ptr<const Texels> texels, ColorSpace space, const Progress* progress = nullptr);

  const std::shared_ptr<const Texels>& texels() const { return texels_; }
  ColorSpace color_space() const { return space_; }
  /// Behind the picture itself, which is not kept again.
  std::span<const Level> levels() const { return levels_; }
  std::size_t memory_bytes() const;

private:
  std::shared_ptr<const Texels> texels_;
  ColorSpace space_;
  std::vector<Level> levels_;
};

} // namespace candela
