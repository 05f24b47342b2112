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
  bool quick = false;             ///< half the size and a sixteenth of the samples, to see what it will be
  bool list = false;              ///< only say what there is
  bool quiet = false;
  int threads = 0; ///< 0: every core
};

/// `candela gallery`: renders the figures of a gallery file. Everything in them but the seconds is the same
/// bytes every time. Returns 0.
int run_gallery(const GalleryOptions& options);

} // namespace candela
