#pragma once
// Pictures that can be made again: a PNG or EXR that Candela writes holds, beside its pixels, the document
// that they came from, as the texts
//
//   candela.scene   the document as Candela JSON (candela_json.h), as if it lay in the picture's folder, with
//   the
//                   picture's samples a pixel as its only criterion to stop
//   candela.files   the files that it refers to: [{"path": …, "bytes": …, "hash": …}], relative to that
//   folder candela.crop    "x,y,width,height", where the picture is a part of the film
//
// Meshes outside of the folder's tree are written into the scene, textures and panoramas are not. A file
// outside of the tree is opened only while it has the recorded content, so that nobody's picture can make the
// program read a file that its maker did not know.

#include "io/images/image_file.h"
#include "io/scene_reader.h"

namespace candela {

struct PictureState {
  Document document;
  int spp = 1;                     ///< of the picture
  std::optional<PictureCrop> crop; ///< what it shows of the film
};

/// Whether pictures of this format hold a state.
constexpr bool holds_state(ImageFormat format) {
  return format == ImageFormat::png || format == ImageFormat::exr;
}

/// The texts for a picture that is to be written to `path`; none if they would be longer than readers take.
ImageMetadata picture_state_texts(const PictureState& state, const std::string& path);

/// Whether the PNG or EXR file holds a state; what reading it throws if it is damaged.
bool holds_picture_state(const std::string& path);

/// Reads the state of a PNG or EXR file. Warns of files that have changed since. Throws input_error for a
/// picture that holds none, and whatever reading a scene does.
LoadedScene read_picture_state(const std::string& path, const ReadOptions& options, WarningList& warnings);

} // namespace candela
