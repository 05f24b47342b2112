#pragma once
// The statements of an MTL file, one material after the other.

#include "core/math.h"
#include "io/files/text_lines.h"
#include "io/files/warning_list.h"
#include "io/obj/map_statement.h"

#include <optional>
#include <string>
#include <vector>

namespace candela {

/// The statements of a material; empty if missing.
struct MtlStatements {
  std::string name; ///< as spelled in the file
  Location where;   ///< of the newmtl
  std::optional<vec3> kd, ks, ke, tf;
  std::optional<float> ns, ni, d;
  std::optional<int> illum;
  struct Map {
    std::string file;
    vec2 scale{1}, offset{0};
    Location where;
  };
  std::optional<Map> map_kd, map_ks, map_ke, map_d, map_ns;
};

/// Reads all lines. Invalid statements are ignored and counted in the warnings with their locations.
std::vector<MtlStatements> parse_mtl(TextLines& lines, const std::string& file, WarningList& warnings);

} // namespace candela
