#pragma once
// What of an EXR is its picture: files hold several parts, and parts several layers, of which many are depth,
// normals, shares of the light.

#include "io/files/warning_list.h"

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <string>

namespace candela {

/// A layer that has colour. Empty names are channels that are not there.
struct ExrLayer {
  int part = 0;
  std::string name; ///< "View Layer.Combined", for messages; empty: that of a file that names none
  std::string r, g, b;
  bool luminance_chroma = false; ///< Y with RY and BY, subsampled
};

/// The layer to be read: the only one that has colour; of several the one called Combined, beauty or rgba, or
/// without a name, else the first, with a warning that names the others. Channels are R, G, B in either case,
/// or Y alone. Throws input_error if there is none.
ExrLayer choose_exr_layer(const Imf::MultiPartInputFile& file, const Location& where, WarningList* warnings);

} // namespace candela
