#include "io/texture_reader.h"

#include "core/color.h"
#include "io/image_codec.h"

#include <filesystem>

namespace candela {

namespace {

bool ends_in_tga(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending == ".tga";
}

std::uint8_t srgb8(float linear) {
  if (!(linear > 0)) return 0; // NaN too
  return static_cast<std::uint8_t>(srgb_from_linear(std::min(linear, 1.0f)) * 255.0f + 0.5f);
}

Picture8 picture_of(const Image& image) {
  Picture8 picture{image.width, image.height, Bytes(image.pixels.size() * 3)};
  std::uint8_t* p = picture.rgb.data();
  for (const vec3& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) *p++ = srgb8(pixel[c]);
  return picture;
}

} // namespace

std::shared_ptr<const Texture> read_texture(const std::string& path) {
  WarningList nobody;
  return read_texture(path, nobody);
}

std::shared_ptr<const Texture> read_texture(const std::string& path, WarningList& warnings) {
  Location where{path};
  warnings.check_stop();
  Bytes bytes = read_file_bytes(path, "image");
  ProgressPart progress = warnings.part(path, bytes.size());
  Picture8 picture;
  if (is_stb_format(bytes))
    picture = decode_stb8(bytes, where);
  else if (is_jpg(bytes))
    picture = decode_jpg(bytes, where, &progress);
  else if (ends_in_tga(path))
    picture = decode_stb8(bytes, where, true);
  else
    picture = picture_of(decode_image(bytes, where, &progress));
  auto texture = std::make_shared<Texture>();
  texture->name = std::filesystem::path(path).filename().string();
  texture->source = path;
  texture->width = picture.width;
  texture->height = picture.height;
  texture->srgb = std::move(picture.rgb);
  return texture;
}

} // namespace candela
