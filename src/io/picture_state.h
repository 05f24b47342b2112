#pragma once
// Pictures that can be rendered again: a PNG or EXR written by Candela holds, besides its pixels, the
// document that it shows, as the texts
//
//   candela.scene   the document as Candela JSON (candela_json.h), as if it were in the picture's folder; its
//                   only stopping criterion is the picture's samples a pixel
//   candela.files   the files that it refers to, relative to that folder:
//                   [{"path": …, "bytes": …, "hash": …}]
//   candela.crop    "x,y,width,height", if the picture is a part of the film
//
// Meshes outside of the folder's tree are written into the scene, textures and panoramas are not. A file
// outside of the tree is opened only if it has the recorded content, so that a picture cannot make the
// program read files unknown to its author.

#include "io/images/image_file.h"
#include "io/scene_reader.h"

namespace candela {

struct PictureState {
  Document document;
  int spp = 1;                     ///< of the picture
  std::optional<PictureCrop> crop; ///< the part of the film that it shows
};

/// Whether pictures of this format can hold a state.
constexpr bool holds_state(ImageFormat format) {
  return format == ImageFormat::png || format == ImageFormat::exr;
}

/// The texts for a picture at `path`; none if they would exceed the readers' limit.
ImageMetadata picture_state_texts(const PictureState& state, const std::string& path);

/// Whether the PNG or EXR file holds a state; throws if the file is damaged.
bool holds_picture_state(const std::string& path);

/// Reads the state of a PNG or EXR file. Warns of files that have changed since. Throws input_error for a
/// picture without a state, and the errors of reading a scene.
LoadedScene read_picture_state(const std::string& path, const ReadOptions& options, WarningList& warnings);

} // namespace candela
