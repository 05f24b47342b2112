#pragma once
// Selects which of several dropped files is opened, and a remark about the others.

#include <string>
#include <vector>

namespace candela {

struct Dropped {
  std::string open;   ///< a scene, a panorama, a photometric file or a volume; empty: none
  std::string remark; ///< the ignored files, or why none can be opened; may be empty
};

/// A folder stands for its only scene. Of several files the first scene is opened: a .json, .xml or .ini,
/// else an .obj, else a picture or another part of a scene, since the former may refer to the latter. An .mtl
/// belongs to its .obj. Reads the disk.
Dropped choose_dropped(const std::vector<std::string>& paths);

} // namespace candela
