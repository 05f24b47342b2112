#include "app/picture_output.h"

#include "io/image_file.h"
#include "render/display_transform.h"

namespace candela {

std::vector<std::uint8_t> displayed_srgb8(const Image& image, const DisplaySettings& display, View view,
                                          float display_scale) {
  std::vector<std::uint8_t> rgb(3 * image.pixels.size());
  display_rgb8(image.pixels,
               display_transform(image.pixels, image.width, image.height, display, view, display_scale), rgb);
  return rgb;
}

Image cropped(Image image, const CropWindow& crop) {
  if (crop.width <= 0) return image;
  Image out{crop.width, crop.height, {}};
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x) out.pixels.push_back(image.at(crop.x + x, crop.y + y));
  return out;
}

void write_picture(const Image& image, const std::string& path, const DisplaySettings& display, View view,
                   float display_scale, int spp) {
  if (is_linear_format(image_format_of(path))) {
    write_linear_image(image, path,
                       {{"candela.version", CANDELA_VERSION}, {"candela.spp", std::to_string(spp)}});
    return;
  }
  write_srgb8_image(image.width, image.height, displayed_srgb8(image, display, view, display_scale), path);
}

} // namespace candela
