#pragma once

#include "io/picture_state.h"
#include "render/film/render_pass.h"

namespace candela {

/// The displayed picture, 8-bit sRGB, three bytes a pixel. `origin` is its position in the frame, of which it
/// may be a part.
std::vector<std::uint8_t> displayed_srgb8(const Image& image, const DisplaySettings& display, View view,
                                          float display_scale, ivec2 origin = ivec2(0));

/// Metadata of a picture: the program's version, the samples a pixel and the denoiser, if any.
ImageMetadata picture_metadata(int spp, bool denoised);

/// Writes a rendered picture in the format of the path's ending: tone-mapped (PNG, JPG, PPM), exactly as the
/// window shows it, or linear (EXR, HDR, PFM). `view` is the quantity that the image holds, `display_scale`
/// is Frame::display_scale, `origin` as above.
void write_picture(const Image& image, const std::string& path, const DisplaySettings& display, View view,
                   float display_scale, const ImageMetadata& metadata, ivec2 origin = ivec2(0));

/// `metadata` for a file at `path`, with the state from which the picture can be rendered again if the format
/// can hold it; warns on stderr if the state is too large.
ImageMetadata with_state(ImageMetadata metadata, const PictureState& state, const std::string& path);

} // namespace candela
