#pragma once
// Pictures for textures.

#include "imaging/texels.h"
#include "io/files/warning_list.h"

#include <memory>
#include <string>

namespace candela {

/// Reads a picture of any format of read_image (io/images/image_file.h), or TGA by its ending, in the file's
/// precision: 8 or 16 bits unchanged, floats linear and finite. Redundant channels are removed; an alpha is
/// kept unless it is 1 everywhere. Throws input_error for a file that cannot be read and limit_error above
/// 65536 pixels a side or 2^28 in all.
std::shared_ptr<const Texels> read_texels(const std::string& path);
/// The same; throws Cancelled when it is cancelled.
std::shared_ptr<const Texels> read_texels(const std::string& path, WarningList& warnings);

} // namespace candela
