#pragma once
// Saves what is on the screen: a PNG of just those bytes and an EXR of the radiance behind them.

#include "session/render_session.h"

#include <filesystem>
#include <string>

namespace candela {

struct SavedPicture {
  std::filesystem::path png;
  std::filesystem::path exr;
};

/// Writes <folder>/<stem>-NNNN.png and .exr with the lowest number that neither has yet. The names are
/// reserved before anything is written, so no file is ever overwritten, not even one that another process
/// makes at the same moment. An output_error if the folder cannot be written to.
SavedPicture save_picture(const DisplayImage& image, const std::filesystem::path& folder,
                          const std::string& stem);

} // namespace candela
