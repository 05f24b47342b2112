#pragma once
// Arbitrary output variables (AOVs): additional pictures of a render.

#include "app/console/outputs.h"
#include "session/offline_render.h"

#include <string>
#include <vector>

namespace candela {

/// A view, or one of the components of the radiance (emitted, direct, indirect), which come from the same
/// samples.
struct Aov {
  std::string name;
  View view = View::radiance;
  int component = -1; ///< 0: emitted, 1: direct, 2: indirect; -1: `view`
};

/// The AOV of a name; a usage error for unknown names.
std::vector<Aov> parse_aovs(const std::vector<std::string>& names);
bool needs_components(const std::vector<Aov>& aovs);

/// "out.exr" for the AOV "normal": "out.normal.exr".
std::string aov_path(const std::string& output, const std::string& name);

/// Writes every AOV next to every output, in the output's format and crop window, and first renders those
/// that the film does not hold. Returns the paths.
std::vector<std::string> write_aovs(const std::vector<Aov>& aovs, const std::vector<std::string>& outputs,
                                    const Document& document, const OfflineResult& rendered,
                                    const OfflineOptions& options, OutputWriter& writer);

} // namespace candela
