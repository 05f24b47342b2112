#pragma once
// Reading and writing of pictures in all formats.

#include "imaging/image.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace candela {

/// The formats that can be written. PNG, JPG and PPM hold 8-bit sRGB, the others linear floats.
enum class ImageFormat { png, jpg, ppm, exr, hdr, pfm };

/// The format of a path's ending, in either case (also ".jpeg" and ".pic"); a usage error that lists the
/// endings for unknown ones.
ImageFormat image_format_of(std::string_view path);

/// Whether the ending, in either case, is that of a picture that read_image might read.
bool is_image_name(std::string_view path);

/// Whether the format holds linear radiance rather than a tone-mapped picture.
constexpr bool is_linear_format(ImageFormat format) { return format >= ImageFormat::exr; }

/// Reads PNG, JPG, BMP, PPM/PGM (decoded from sRGB), EXR, HDR and PFM (linear). The content decides the
/// format, not the name. Alpha is dropped; a grey picture has three equal channels, a channel that an EXR
/// lacks is 0; of an EXR the data window is read, and colours are brought to Rec. 709 if the file names other
/// primaries. Throws input_error for a file that cannot be read, limit_error above 65536 pixels a side or
/// 2^28 in all.
Image read_image(const std::string& path);

/// Text (UTF-8) to store in the file, by name: chunks in PNG, string attributes in EXR, header lines in HDR.
/// The other formats do not support it.
using ImageMetadata = std::map<std::string, std::string>;

/// Writes EXR (32-bit float, ZIP), HDR (negative and NaN channels become 0) or PFM by the ending. Writes
/// atomically. A usage error for other endings, output_error if the file cannot be written.
void write_linear_image(const Image& image, const std::string& path, const ImageMetadata& metadata = {});

/// A picture of a file that has several; its channels are called "name.R", "name.G" and "name.B".
struct ImageLayer {
  std::string name;
  Image image;
};
/// Writes an EXR of the image and layers of its size, beside each other, as write_linear_image().
void write_exr_layers(const Image& image, std::span<const ImageLayer> layers, const std::string& path,
                      const ImageMetadata& metadata = {});

/// Writes PNG, JPG (quality 95) or PPM by the ending, from rows of three bytes a pixel, top row first.
void write_srgb8_image(int width, int height, std::span<const std::uint8_t> rgb, const std::string& path,
                       const ImageMetadata& metadata = {});

/// The same for screenshots: writes to the first of stem.png, stem-2.png … in the folder that does not exist,
/// and returns its path.
std::string write_srgb8_image_uniquely(int width, int height, std::span<const std::uint8_t> rgb,
                                       const std::string& folder, const std::string& stem,
                                       ImageFormat format = ImageFormat::png);

} // namespace candela
