#pragma once
// Pictures that colour surfaces.

#include "imaging/texture.h"
#include "io/files/warning_list.h"

#include <memory>
#include <string>

namespace candela {

/// Reads a picture of any format that read_image knows (io/images/image_file.h), or TGA by its ending, as
/// 8-bit sRGB. Float formats are linear and clipped to [0, 1]; alpha is dropped. `name` becomes the file's
/// name without its folder, `source` the path as given. Throws input_error for a file that cannot be read and
/// limit_error above 65536 pixels a side or 2^28 in all.
std::shared_ptr<const Texture> read_texture(const std::string& path);
/// The same; told to stop, it throws Cancelled.
std::shared_ptr<const Texture> read_texture(const std::string& path, WarningList& warnings);

} // namespace candela
