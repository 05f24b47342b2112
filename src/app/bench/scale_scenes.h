#pragma once
// The scenes of `candela bench scale`, as files that any user can open.

#include <cstddef>
#include <string>

namespace candela {

/// Sizes of the textures, texels.
struct ScaleDetail {
  int ground = 4096;
  int stone = 1024;
  int sky = 2048; ///< width of the panorama
};

/// Writes the files that the scenes of a folder share: sky.hdr, ground.jpg, stone.png and landscape.mtl.
void write_scale_assets(const std::string& folder, const ScaleDetail& detail);

/// Writes mountains under sun and sky, of at least so many distinct triangles, as NAME.obj and NAME.json.
/// Returns the path of the latter.
std::string write_landscape(const std::string& folder, const std::string& name, std::size_t triangles);

/// Writes instances of one stone of at least so many triangles, in a spiral, as NAME.obj and NAME.json.
/// Returns the path of the latter.
std::string write_stones(const std::string& folder, const std::string& name, int instances,
                         std::size_t triangles);

} // namespace candela
