#include "app/console/picture_output.h"

#include "app/platform/streams.h"
#include "imaging/display_transform.h"
#include "render/denoise/denoise_film.h"

#include <fmt/format.h>

namespace candela {

std::vector<std::uint8_t> displayed_srgb8(const Image& image, const DisplaySettings& display, View view,
                                          float display_scale, ivec2 origin) {
  std::vector<std::uint8_t> rgb(3 * image.pixels.size());
  display_rgb8(image.pixels, {image.width, origin},
               display_transform(image.pixels, image.width, image.height, display, view, display_scale), rgb);
  return rgb;
}

ImageMetadata picture_metadata(int spp, bool denoised) {
  ImageMetadata metadata{{"candela.version", CANDELA_VERSION}, {"candela.spp", std::to_string(spp)}};
  if (denoised)
    metadata["candela.denoised"] = fmt::format("of {} samples a pixel, by {}", spp, denoiser_name());
  return metadata;
}

ImageMetadata with_state(ImageMetadata metadata, const PictureState& state, const std::string& path) {
  if (!holds_state(image_format_of(path))) return metadata;
  ImageMetadata texts = picture_state_texts(state, path);
  if (texts.empty()) say("candela: warning: {}: the scene is too large to be kept in the picture\n", path);
  metadata.merge(texts);
  return metadata;
}

void write_picture(const Image& image, const std::string& path, const DisplaySettings& display, View view,
                   float display_scale, const ImageMetadata& metadata, ivec2 origin) {
  if (is_linear_format(image_format_of(path)))
    write_linear_image(image, path, metadata);
  else
    write_srgb8_image(image.width, image.height, displayed_srgb8(image, display, view, display_scale, origin),
                      path, metadata);
}

} // namespace candela
