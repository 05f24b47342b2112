#include "io/image_codec.h"

#include <fmt/format.h>

namespace candela {

void check_image_size(const Location& where, std::int64_t width, std::int64_t height) {
  if (width <= 0 || height <= 0)
    throw damaged_image(where, fmt::format("its size is {} x {} pixels", width, height));
  if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
    throw limit_error(where, "image",
                      fmt::format("{} x {} pixels are more than {} a side or {} in all", width, height,
                                  kMaxImageSide, kMaxImagePixels),
                      "scale it down");
}

Error damaged_image(const Location& where, std::string_view cause) {
  return input_error(where, "image", cause, "save it again from an image program");
}

} // namespace candela
