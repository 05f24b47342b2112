#pragma once
// Selects the main image of an EXR: files have several parts and parts several layers, many of which are
// depth, normals or components of the light.

#include "io/files/warning_list.h"

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <string>

namespace candela {

/// A colour layer. Empty names are missing channels.
struct ExrLayer {
  int part = 0;
  std::string name; ///< "View Layer.Combined", for messages; empty: that of a file that names none
  std::string r, g, b;
  bool luminance_chroma = false; ///< Y with RY and BY, subsampled
};

/// The layer to read: the only colour layer; of several, the one called Combined, beauty or rgba, or the one
/// without a name; else the first, with a warning that lists the others. Channels are R, G, B in either case,
/// or only Y. Throws input_error if there is none.
ExrLayer choose_exr_layer(const Imf::MultiPartInputFile& file, const Location& where, WarningList* warnings);

} // namespace candela
