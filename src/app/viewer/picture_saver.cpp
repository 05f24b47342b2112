#include "app/viewer/picture_saver.h"

#include "app/console/picture_output.h"
#include "core/error.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace candela {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxPictures = 100000;

/// Creates the file; false if it exists.
bool reserve(const fs::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file >= 0) {
    ::close(file);
    return true;
  }
  if (errno == EEXIST) return false;
  throw output_error(path.string(), std::generic_category().message(errno),
                     "start Candela in a folder that you may write to");
}

/// The state from which the picture can be rendered again.
PictureState state_of(const DisplayImage& image) {
  const Frame& frame = *image.frame;
  PictureState state{*frame.document, std::max(image.denoised ? image.denoised->spp : frame.spp, 1), {}};
  state.document.settings.display = image.display; // changing these restarts no accumulation
  state.document.settings.view = frame.view;
  return state;
}

SavedPicture reserve_names(const fs::path& folder, const std::string& stem) {
  for (int number = 1; number < kMaxPictures; ++number) {
    const fs::path base = folder / fmt::format("{}-{:04}", stem, number);
    SavedPicture names{fs::path(base) += ".png", fs::path(base) += ".exr"};
    if (!reserve(names.png)) continue;
    if (reserve(names.exr)) return names;
    fs::remove(names.png);
  }
  throw output_error((folder / stem).string(), "every number is taken", "move the pictures elsewhere");
}

} // namespace

SavedPicture save_picture(const DisplayImage& image, const fs::path& folder, const std::string& stem) {
  SavedPicture names = reserve_names(folder, stem);
  try {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      rgb.insert(rgb.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                 image.rgba.begin() + static_cast<std::ptrdiff_t>(i + 3));
    const ImageMetadata metadata =
        picture_metadata(image.denoised ? image.denoised->spp : image.frame->spp, image.denoised != nullptr);
    const PictureState state = state_of(image);
    write_srgb8_image(image.width, image.height, rgb, names.png.string(),
                      with_state(metadata, state, names.png.string()));
    write_linear_image({image.width, image.height, image.linear()}, names.exr.string(),
                       with_state(metadata, state, names.exr.string()));
  } catch (...) { // the reserved names are still empty files: remove them
    std::error_code ignored;
    fs::remove(names.png, ignored);
    fs::remove(names.exr, ignored);
    throw;
  }
  return names;
}

} // namespace candela
