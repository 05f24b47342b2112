#include "lights/panorama.h"

#include "core/color.h"

namespace candela {

std::string panorama_problem(const Panorama& panorama) {
  const Image& image = panorama.image;
  if (image.width <= 0 || image.height <= 0 ||
      image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    return "its pixels do not fit its size; give width times height";
  for (vec3 pixel : image.pixels)
    if (!(is_finite(pixel) && min_component(pixel) >= 0))
      return "a pixel is negative or not finite; give radiances";
  return {};
}

} // namespace candela
