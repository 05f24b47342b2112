#pragma once
// Arbitrary output variables (AOVs): additional pictures of a render.

#include "app/console/outputs.h"
#include "session/offline_render.h"

#include <string>
#include <vector>

namespace candela {

/// A view, one of the components of the radiance (emitted, direct, indirect), which come from the same
/// samples, or the radiance of each light group.
struct Aov {
  std::string name;
  View view = View::radiance;
  int component = -1;  ///< 0: emitted, 1: direct, 2: indirect; -1: `view`
  bool groups = false; ///< the light groups, as layers of one EXR
};

/// The AOV of a name; a usage error for unknown names.
std::vector<Aov> parse_aovs(const std::vector<std::string>& names);
bool needs_components(const std::vector<Aov>& aovs);

/// A usage error where the document has none of them: light groups that the film does not keep apart.
void check_aovs(const std::vector<Aov>& aovs, const Document& document);

/// Where the AOV of these outputs goes: "out.exr" for "normal": "out.normal.exr". The light groups are an EXR
/// whatever the output is.
std::vector<std::string> aov_paths(const Aov& aov, const std::vector<std::string>& outputs);

/// Names of the layers of an EXR that has the light groups: as Blender names its passes, "Combined_" and the
/// name of the group; "Combined_ungrouped" has the other lights. Characters that mean something in such
/// names become '_'; equal names get a number.
std::vector<std::string> layer_names(const LightLayers& layers);

/// Writes every AOV next to every output, in the output's format and crop window, and first renders those
/// that the film does not hold. The EXR of light groups has the picture, not denoised, and every layer at
/// factor 1. Returns the paths.
std::vector<std::string> write_aovs(const std::vector<Aov>& aovs, const std::vector<std::string>& outputs,
                                    const Document& document, const OfflineResult& rendered,
                                    const OfflineOptions& options, OutputWriter& writer);

} // namespace candela
