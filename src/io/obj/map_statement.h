#pragma once
// The map_… statements of an MTL file: options, then a file name.

#include "core/math.h"

#include <string_view>
#include <vector>

namespace candela {

struct MapStatement {
  std::string_view file;    ///< empty if it names none; may have spaces
  vec2 scale{1}, offset{0}; ///< u and v of -s and -o: the picture is looked up at scale * uv + offset
  std::vector<std::string_view> ignored; ///< options that mean something, but not here: "-clamp"
};

/// Reads what follows the key. Options have as many arguments as the specification (Wavefront, "Material
/// library file format", 1995) gives them; v and w of -o, -s and -t may be left out. A word that begins with
/// '-' but is not an option begins the file's name, as does any word after the options.
MapStatement read_map_statement(std::string_view words);

} // namespace candela
