#pragma once
// Pictures for textures.

#include "imaging/texels.h"
#include "io/files/warning_list.h"

#include <memory>
#include <string>

namespace candela {

/// Reads a picture of any format that read_image knows (io/images/image_file.h), or TGA by its ending, in the
/// precision that it has: 8 or 16 bits as they stand in the file, floats linear and finite. With the fewest
/// channels that tell the same; an alpha is kept where it says anything. Throws input_error for a file that
/// cannot be read and limit_error above 65536 pixels a side or 2^28 in all.
std::shared_ptr<const Texels> read_texels(const std::string& path);
/// The same; told to stop, it throws Cancelled.
std::shared_ptr<const Texels> read_texels(const std::string& path, WarningList& warnings);

} // namespace candela
