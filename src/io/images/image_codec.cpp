#include "io/images/image_codec.h"

#include "core/color.h"

#include <fmt/format.h>

#include <array>

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

Image linear_image(const Picture8& picture) {
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < 256; ++i) linear[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
  Image image{picture.width, picture.height, std::vector<vec3>(picture.rgb.size() / 3)};
  const std::uint8_t* p = picture.rgb.data();
  for (vec3& pixel : image.pixels) pixel = {linear[p[0]], linear[p[1]], linear[p[2]]}, p += 3;
  return image;
}

void make_finite(Image& image, const Location& where, WarningList& warnings) {
  constexpr float kLargestHalf = 65504;
  float most = kLargestHalf;
  std::size_t nans = 0, infinities = 0;
  for (const vec3& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) {
      if (std::isfinite(pixel[c]))
        most = std::max(most, pixel[c]);
      else
        ++(std::isnan(pixel[c]) ? nans : infinities);
    }
  if (nans + infinities == 0) return;
  for (vec3& pixel : image.pixels)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(pixel[c])) pixel[c] = std::isnan(pixel[c]) ? 0 : std::copysign(most, pixel[c]);
  if (infinities > 0)
    warnings.add(where, fmt::format("{} values are infinite: taken for {}", infinities, most));
  if (nans > 0) warnings.add(where, fmt::format("{} values are not numbers: taken for 0", nans));
}

} // namespace candela
