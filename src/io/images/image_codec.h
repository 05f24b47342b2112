#pragma once
// Common parts of the image formats of this folder, and their entry points. Only image_file.cpp,
// texels_reader.cpp and panorama_reader.cpp use these; other code includes their headers.
//
// Decoders take the whole file. They throw input_error for damaged files and limit_error for too large ones,
// located at `where`, before pixels are allocated. They report to `progress`, which may be null, and throw
// Cancelled when it is cancelled; PNG, BMP and TGA cannot be interrupted and are run in a thread that can be
// abandoned (io/files/apart.h).

#include "core/error.h"
#include "core/progress.h"
#include "imaging/image.h"
#include "imaging/texels.h"
#include "io/files/file_bytes.h"
#include "io/files/warning_list.h"
#include "io/images/image_file.h"

#include <optional>
#include <string>
#include <string_view>

namespace candela {

/// Limits of all readers of pictures.
inline constexpr std::int64_t kMaxImageSide = 65536;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 28;

/// Limit of a decompressed text in a picture.
inline constexpr std::size_t kMaxPictureText = std::size_t{1} << 28;

/// Throws input_error unless both sides are positive, limit_error above the limits.
void check_image_size(const Location& where, std::int64_t width, std::int64_t height);

/// The error of a damaged file.
Error damaged_image(const Location& where, std::string_view cause);

/// 8 bits a channel, row 0 is the top, encoded as sRGB.
struct Picture8 {
  int width = 0;
  int height = 0;
  Bytes rgb;
};

// image_file.cpp: the format is known by its signature.
Image decode_image(ByteView bytes, const Location& where, ProgressPart* progress = nullptr,
                   WarningList* warnings = nullptr);

/// The linear picture.
Image linear_image(const Picture8& picture);

/// Makes the pixels of a picture finite: NaN becomes 0, an infinity becomes 65504 (the largest half of EXR)
/// or the picture's largest finite value, if that is larger. Both are counted in a warning.
void make_finite(Image& image, const Location& where, WarningList& warnings);

// stb_codec.cpp: PNG, BMP and (`tga`: it has no signature, so the caller has to
// know) TGA, whichever way its rows and columns run. Alpha is dropped but in
// decode_stb_texels; PNGs of 16 bits keep them in that and in decode_stb.
bool is_stb_format(ByteView bytes);
Picture8 decode_stb8(ByteView bytes, const Location& where, bool tga = false);
Image decode_stb(ByteView bytes, const Location& where, bool tga = false);
Texels decode_stb_texels(ByteView bytes, const Location& where, bool tga = false);
/// Throws std::bad_alloc when out of memory.
Bytes encode_png(int width, int height, ByteView rgb);

// png_check.cpp: structure and checksums of a PNG, which stb_image does not check.
bool is_png(ByteView bytes);
void check_png(ByteView bytes, const Location& where);

// png_text.cpp: text in a PNG.
/// Adds iTXt chunks before the end; long texts are compressed.
Bytes with_png_text(Bytes png, const ImageMetadata& text);
/// The text of that name (in an iTXt chunk), if there is one. The PNG must have passed check_png. Throws
/// damaged_image for a truncated chunk, limit_error above kMaxPictureText bytes of text.
std::optional<std::string> png_text(ByteView bytes, std::string_view name, const Location& where);

// jpg.cpp: JPEG, grey and colour; written with quality 95 and colour in full
// resolution.
bool is_jpg(ByteView bytes);
Picture8 decode_jpg(ByteView bytes, const Location& where, ProgressPart* progress = nullptr);
/// `path` is for messages. output_error for sizes that the format does not support (above 65500).
Bytes encode_jpg(int width, int height, ByteView rgb, const std::string& path);

// pnm.cpp: PPM and PGM (P2, P3, P5, P6), up to 16 bits, read as sRGB; written
// as P6.
bool is_pnm(ByteView bytes);
Image decode_pnm(ByteView bytes, const Location& where, ProgressPart* progress = nullptr);
/// In 8 bits where the file's largest value is at most 255, else in 16.
Texels decode_pnm_texels(ByteView bytes, const Location& where, ProgressPart* progress = nullptr);
Bytes encode_ppm(int width, int height, ByteView rgb);

// exr.cpp: OpenEXR, flat parts, any compression; written as 32-bit float, ZIP.
// Of several parts or layers one is read (io/images/exr_layers.h), and the warnings name
// the others.
bool is_exr(ByteView bytes);
Image decode_exr(ByteView bytes, const Location& where, ProgressPart* progress = nullptr,
                 WarningList* warnings = nullptr);
/// The string attribute of that name; nothing if there is none.
std::optional<std::string> exr_text(ByteView bytes, const std::string& name, const Location& where);
/// `path` is for messages.
/// `layers` beside the image, of its size.
Bytes encode_exr(const Image& image, const std::string& path, const ImageMetadata& metadata,
                 std::span<const ImageLayer> layers = {});

// hdr.cpp: Radiance RGBE.
bool is_hdr(ByteView bytes);
Image decode_hdr(ByteView bytes, const Location& where, ProgressPart* progress = nullptr);
Bytes encode_hdr(const Image& image, const ImageMetadata& metadata);

// pfm.cpp: portable float map, colour and grey, either byte order.
bool is_pfm(ByteView bytes);
Image decode_pfm(ByteView bytes, const Location& where, ProgressPart* progress = nullptr);
Bytes encode_pfm(const Image& image);

} // namespace candela
