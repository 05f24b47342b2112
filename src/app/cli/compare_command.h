#pragma once

#include <optional>
#include <string>

namespace candela {

/// `candela compare A B [--diff OUT.png]`: prints comparison_json (imaging/compare.h) of picture `a` against
/// reference `b` on stdout; with a diff path, writes relative_error_picture there. Returns 0; throws
/// input_error if a picture cannot be read or their sizes differ, a usage error for a diff's ending that
/// holds no 8-bit picture.
int run_compare(const std::string& a, const std::string& b, const std::optional<std::string>& diff_path);

} // namespace candela
