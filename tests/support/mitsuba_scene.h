#pragma once
// Scenes of another renderer's own tests, for comparisons with its pictures.

#include "scene/document.h"

#include <string>

namespace candela::test {

/// Reads a scene of Mitsuba 3's XML, as far as the surfaces and lights of Mitsuba's test scenes need it:
/// includes, OBJ and binary PLY meshes, spheres, rectangles, instances, and the BSDFs, textures and emitters
/// that both renderers have. Materials that scatter on one side alone there do so here. Throws
/// std::runtime_error for anything else, so that nothing is ever left out of a comparison unseen.
/// `patterns_upside_down`: Mitsuba counted v of OBJ files upwards where it draws checkers when it made the
/// picture to be compared with; it counts it downwards since then.
Document read_mitsuba_scene(const std::string& path, bool patterns_upside_down = true);

} // namespace candela::test
