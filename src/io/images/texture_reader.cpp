#include "io/images/texture_reader.h"

#include "core/color.h"
#include "io/files/apart.h"
#include "io/images/image_codec.h"

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

Picture8 decode(ByteView bytes, const std::string& path, ProgressPart* progress, WarningList& warnings) {
  const Location where{path};
  if (is_stb_format(bytes)) return decode_stb8(bytes, where);
  if (is_jpg(bytes)) return decode_jpg(bytes, where, progress);
  if (ends_in_tga(path)) return decode_stb8(bytes, where, true);
  Image image = decode_image(bytes, where, progress, &warnings);
  make_finite(image, where, warnings);
  return picture_of(image);
}

} // namespace

std::shared_ptr<const Texture> read_texture(const std::string& path) {
  WarningList nobody;
  return read_texture(path, nobody);
}

std::shared_ptr<const Texture> read_texture(const std::string& path, WarningList& warnings) {
  warnings.check_stop();
  auto bytes = std::make_shared<const Bytes>(read_file_bytes(path, "image", &warnings.progress()));
  ProgressPart progress = warnings.part(path, bytes->size());
  Picture8 picture = run_apart(&progress, &warnings, [bytes, path](ProgressPart* part, WarningList* said) {
    return decode(*bytes, path, part, *said);
  });
  auto texture = std::make_shared<Texture>();
  texture->name = std::filesystem::path(path).filename().string();
  texture->source = path;
  texture->width = picture.width;
  texture->height = picture.height;
  texture->srgb = std::move(picture.rgb);
  return texture;
}

} // namespace candela
