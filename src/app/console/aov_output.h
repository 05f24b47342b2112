#pragma once
// Arbitrary output variables: further pictures of a render, beside the one that its settings ask for.

#include "app/console/outputs.h"
#include "session/offline_render.h"

#include <string>
#include <vector>

namespace candela {

/// One of the views' names, or emitted, direct, indirect: parts of the radiance, separated by the same
/// samples.
struct Aov {
  std::string name;
  View view = View::radiance;
  int component = -1; ///< 0: emitted, 1: direct, 2: indirect; -1: `view`
};

/// A usage error where there is no such name.
std::vector<Aov> parse_aovs(const std::vector<std::string>& names);
bool needs_components(const std::vector<Aov>& aovs);

/// "out.exr" for the AOV "normal": "out.normal.exr".
std::string aov_path(const std::string& output, const std::string& name);

/// Renders what the film does not hold, and writes every AOV beside every output, in its format, of the crop
/// window alone as the output is. Returns the paths.
std::vector<std::string> write_aovs(const std::vector<Aov>& aovs, const std::vector<std::string>& outputs,
                                    const Document& document, const OfflineResult& rendered,
                                    const OfflineOptions& options, OutputWriter& writer);

} // namespace candela
