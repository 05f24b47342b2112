#pragma once

#include "app/figures/gallery.h"

#include <string>
#include <vector>

namespace candela {

struct GalleryOptions {
  std::vector<std::string> names; ///< figures to make; empty: all
  std::string file;               ///< empty: scenes/gallery.json of the installation
  std::string folder = ".";       ///< where the figures go, as NAME.png; made if it is not there
  float spp_scale = 1;            ///< multiplies all samples a pixel, also of references
  bool quick = false;             ///< half the size and a sixteenth of the samples, for a preview
  bool list = false;              ///< only list the figures
  bool quiet = false;
  int threads = 0; ///< 0: every core
};

/// `candela gallery`: renders the figures of a gallery file. Every run gives the same bytes, apart from
/// render times in the captions. Returns 0.
int run_gallery(const GalleryOptions& options);

} // namespace candela
