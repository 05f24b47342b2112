#pragma once
// Panoramas of environment lights from picture files.

#include "io/files/warning_list.h"
#include "scene/scene_desc.h"

#include <memory>
#include <span>
#include <string>

namespace candela {

/// Reads one picture, or the six faces of a cube, which are stacked in the order of the files and must have
/// the same size. Values are clamped to [0, 1e9], the range of a light's colour; infinite ones become the
/// largest finite value, at least 65504, and NaN becomes 0; each correction is a warning. Throws as
/// read_image does, limit_error if the faces together exceed its limits, and Cancelled.
std::shared_ptr<const Panorama> read_panorama(std::span<const std::string> paths, WarningList& warnings);

/// A warning if the picture's proportions do not fit the mapping; empty if they do.
std::string mapping_problem(EnvironmentMapping mapping, int width, int height);

/// The mapping that fits the picture's proportions; latlong if none does.
EnvironmentMapping likely_mapping(const Image& image);

/// Gives a picture to the scene. Where the light `preferred` is a projector, or a point light that has a
/// picture, it becomes the light's. Else it is the environment, with likely_mapping(): in `preferred` if that
/// is one, else in the first environment, else replacing the first constant light, else as a new light.
/// Returns the light's index.
std::size_t set_environment(SceneDesc& scene, std::shared_ptr<const Panorama> panorama,
                            std::size_t preferred = 0);

} // namespace candela
