#pragma once
// Saves the displayed picture: a PNG with exactly those bytes, and an EXR with the linear values.

#include "session/render_session.h"

#include <filesystem>
#include <string>

namespace candela {

struct SavedPicture {
  std::filesystem::path png;
  std::filesystem::path exr;
};

/// Writes <folder>/<stem>-NNNN.png and .exr with the lowest number that is free for both. The names are
/// reserved first, so that no file is overwritten, even if another process creates files at the same time. An
/// output_error if the folder cannot be written to.
SavedPicture save_picture(const DisplayImage& image, const std::filesystem::path& folder,
                          const std::string& stem);

} // namespace candela
