#pragma once
// Panoramas of environment lights, from picture files.

#include "io/files/warning_list.h"
#include "scene/scene_desc.h"

#include <memory>
#include <span>
#include <string>

namespace candela {

/// Reads one picture, or the six faces of a cube, which are stacked in the order of the files and must be of
/// one size. Values are brought into [0, 1e9], which is what a light's colour may be; infinite ones become
/// the largest finite one, but at least 65504, and NaN becomes 0; all that is a warning. Throws as read_image
/// does, limit_error if the faces together exceed its caps, and Cancelled.
std::shared_ptr<const Panorama> read_panorama(std::span<const std::string> paths, WarningList& warnings);

/// What is odd about a picture of this size under this mapping; empty if nothing is.
std::string mapping_problem(EnvironmentMapping mapping, int width, int height);

/// The mapping whose proportions a picture has; latlong if it has none's.
EnvironmentMapping likely_mapping(const Image& image);

/// Lights the scene with a panorama, by the mapping that it likely has: in the light `preferred` if that is
/// an environment, else in the first that is, else in the place of the first constant light, else by a light
/// of its own. Returns the light's index.
std::size_t set_environment(SceneDesc& scene, std::shared_ptr<const Panorama> panorama,
                            std::size_t preferred = 0);

} // namespace candela
