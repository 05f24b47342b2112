#include "io/images/image_file.h"

#include "io/files/atomic_file.h"
#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace candela {

namespace {

struct Ending {
  std::string_view text;
  ImageFormat format;
};
constexpr std::array kEndings = {Ending{".png", ImageFormat::png},  Ending{".jpg", ImageFormat::jpg},
                                 Ending{".jpeg", ImageFormat::jpg}, Ending{".ppm", ImageFormat::ppm},
                                 Ending{".exr", ImageFormat::exr},  Ending{".hdr", ImageFormat::hdr},
                                 Ending{".pic", ImageFormat::hdr},  Ending{".pfm", ImageFormat::pfm}};

/// The ending of the path's last part, in lower case.
std::string ending_of(std::string_view path) {
  if (auto slash = path.rfind('/'); slash != std::string_view::npos) path.remove_prefix(slash + 1);
  auto dot = path.rfind('.');
  std::string ending(dot == std::string_view::npos ? "" : path.substr(dot));
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

void check_written_size(const std::string& path, std::int64_t width, std::int64_t height, std::size_t values,
                        std::size_t due) {
  if (width <= 0 || height <= 0 || values != due)
    throw output_error(path, fmt::format("a picture of {} x {} pixels has {} values", width, height, values),
                       "give it pixels");
}

Bytes encode_srgb8(ImageFormat format, int width, int height, ByteView rgb, const std::string& path,
                   const ImageMetadata& metadata = {}) {
  return format == ImageFormat::png   ? with_png_text(encode_png(width, height, rgb), metadata)
         : format == ImageFormat::jpg ? encode_jpg(width, height, rgb, path)
                                      : encode_ppm(width, height, rgb);
}

} // namespace

ImageFormat image_format_of(std::string_view path) {
  std::string ending = ending_of(path);
  for (const Ending& known : kEndings)
    if (known.text == ending) return known.format;
  throw usage_error(path,
                    ending.empty() ? std::string("the name has no ending that tells the format")
                                   : fmt::format("no image format has the ending '{}'", ending),
                    "use .png, .jpg or .ppm (tone-mapped) or .exr, .hdr or .pfm (linear)");
}

bool is_image_name(std::string_view path) {
  constexpr std::string_view kOnlyRead[] = {".bmp", ".pgm", ".pnm"};
  std::string ending = ending_of(path);
  return std::ranges::find(kEndings, ending, &Ending::text) != kEndings.end() ||
         std::ranges::find(kOnlyRead, ending) != std::end(kOnlyRead);
}

Image decode_image(ByteView bytes, const Location& where, ProgressPart* progress, WarningList* warnings) {
  if (is_stb_format(bytes)) return decode_stb(bytes, where);
  if (is_jpg(bytes)) return linear_image(decode_jpg(bytes, where, progress));
  if (is_exr(bytes)) return decode_exr(bytes, where, progress, warnings);
  if (is_hdr(bytes)) return decode_hdr(bytes, where, progress);
  if (is_pfm(bytes)) return decode_pfm(bytes, where, progress);
  if (is_pnm(bytes)) return decode_pnm(bytes, where, progress);
  throw input_error(where, "image",
                    bytes.empty() ? "the file is empty" : "its content has no known image format",
                    "use PNG, JPG, BMP, PPM, EXR, HDR or PFM");
}

Image read_image(const std::string& path) { return decode_image(read_file_bytes(path, "image"), {path}); }

void write_linear_image(const Image& image, const std::string& path, const ImageMetadata& metadata) {
  check_written_size(path, image.width, image.height, image.pixels.size(),
                     static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  switch (image_format_of(path)) {
  case ImageFormat::exr: return write_file_atomically(path, encode_exr(image, path, metadata));
  case ImageFormat::hdr: return write_file_atomically(path, encode_hdr(image, metadata));
  case ImageFormat::pfm: return write_file_atomically(path, encode_pfm(image));
  case ImageFormat::png:
  case ImageFormat::jpg:
  case ImageFormat::ppm: break;
  }
  throw usage_error(path, "the format does not hold linear values", "use .exr, .hdr or .pfm");
}

void write_exr_layers(const Image& image, std::span<const ImageLayer> layers, const std::string& path,
                      const ImageMetadata& metadata) {
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  check_written_size(path, image.width, image.height, image.pixels.size(), pixels);
  for (const ImageLayer& layer : layers)
    check_written_size(path, image.width, image.height, layer.image.pixels.size(), pixels);
  write_file_atomically(path, encode_exr(image, path, metadata, layers));
}

void write_srgb8_image(int width, int height, std::span<const std::uint8_t> rgb, const std::string& path,
                       const ImageMetadata& metadata) {
  check_written_size(path, width, height, rgb.size(),
                     static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  ImageFormat format = image_format_of(path);
  if (is_linear_format(format))
    throw usage_error(path, "the format holds linear values", "use .png, .jpg or .ppm");
  write_file_atomically(path, encode_srgb8(format, width, height, rgb, path, metadata));
}

std::string write_srgb8_image_uniquely(int width, int height, std::span<const std::uint8_t> rgb,
                                       const std::string& folder, const std::string& stem,
                                       ImageFormat format) {
  std::string ending = format == ImageFormat::png ? ".png" : format == ImageFormat::jpg ? ".jpg" : ".ppm";
  check_written_size(stem + ending, width, height, rgb.size(),
                     static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  return write_file_uniquely(folder, stem, ending, encode_srgb8(format, width, height, rgb, stem + ending));
}

} // namespace candela
