#pragma once
// Which of the files that were dropped at once is opened, and what is said about the others.

#include <string>
#include <vector>

namespace candela {

struct Dropped {
  std::string open;   ///< a scene, or a picture that lights one; empty: nothing of it
  std::string remark; ///< which files are ignored, or why there is nothing to open; may be empty
};

/// A folder stands for the one scene in it. Of several files the first scene is opened: a .json, .xml or
/// .ini, else an .obj, else a picture, since the former name the latter as their parts. An .mtl goes with its
/// .obj. Reads the disk.
Dropped choose_dropped(const std::vector<std::string>& paths);

} // namespace candela
