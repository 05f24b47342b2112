#pragma once
// A file that describes reproducible figures: scenes and settings side by side, compared with a reference.
//
//   {
//     "gallery": 1,
//     "figures": [
//       {"name": "hero", "scene": "cornell_spheres.json", "size": [512, 512], "spp": 1024},
//       {
//         "name": "samplers",
//         "title": "Four samplers, 16 samples a pixel each",
//         "scene": "cornell_flush.json", "size": [256, 256], "spp": 16,
//         "settings": {"path.max_depth": 3},
//         "panels": [
//           {"label": "Independent", "settings": {"sampler.type": "independent"}},
//           {"label": "Sobol'", "settings": {"sampler.type": "sobol"}, "spp": 8}
//         ],
//         "columns": 2,
//         "details": [[40, 120, 48, 36]],
//         "reference": {"spp": 4096, "settings": {"sampler.type": "independent"}, "show": true},
//         "difference": true,
//         "plot": {"spp": [1, 4, 16, 64], "x": "samples"}
//       }
//     ]
//   }
//
// A figure without panels is that one render as a plain picture. All but "name" and "scene" may be left out;
// size and spp are the scene's then. Settings are the keys of settings_table(), as for --set (size and spp
// have their own keys); those of a panel come over those of its figure. A panel may name a scene of its own,
// but not in a figure with a reference. With a reference, captions state the relMSE, "difference" shows the
// relative error of every panel in false colour, and "plot" draws relMSE over samples or seconds at the
// listed samples a pixel. "details" are [x, y, width, height] in pixels. Scenes are named relative to the
// file and lie in its folder's tree. Comments are allowed.

#include "app/figures/canvas.h"
#include "scene/document.h"

#include <optional>
#include <string>
#include <vector>

namespace candela {

struct GalleryPanel {
  std::string label;
  std::string scene;                 ///< path
  std::vector<std::string> settings; ///< KEY=VALUE, in the order in which they are applied
  int spp = 0;                       ///< 0: the scene's
};

struct GalleryReference {
  int spp = 1024;
  std::vector<std::string> settings;
  bool show = false; ///< as a panel of its own
};

struct GalleryPlot {
  std::vector<int> spp;
  bool over_seconds = false;
};

struct GalleryFigure {
  std::string name; ///< name of the file: letters, digits, '-' and '_'
  std::string title;
  bool plain = false; ///< one render without texts
  ivec2 size{0};      ///< 0: the scene's
  int columns = 0;
  std::vector<GalleryPanel> panels; ///< at least one
  std::vector<Box> details;
  std::optional<GalleryReference> reference;
  bool difference = false;
  std::optional<GalleryPlot> plot;
};

/// Reads the file; errors have line and column. Scenes must exist but are not opened.
std::vector<GalleryFigure> read_gallery(const std::string& path);

} // namespace candela
