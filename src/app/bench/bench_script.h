#pragma once
// The input of `candela bench interactive`: a camera flight and edits, the same in every run.

#include "core/math.h"
#include "scene/document.h"

namespace candela {

enum class InputKind {
  camera,   ///< one mouse movement that turns the camera, then a rest
  flight,   ///< sixty mouse movements a second without rest
  material, ///< a colour
  light,    ///< the strength of a light or an emitter
  setting,  ///< the seed, so that the work stays the same
  object,   ///< a transform: the geometry is built again
};
inline constexpr InputKind kInputKinds[] = {InputKind::camera, InputKind::flight,  InputKind::material,
                                            InputKind::light,  InputKind::setting, InputKind::object};

const char* to_string(InputKind kind);

/// The mouse position at a step of the flight, framebuffer pixels: a figure of eight about the window's
/// centre. Consecutive steps never have the same position.
vec2 flight_position(int step, ivec2 window);

/// Whether the scene has an object that the kind of input edits.
bool can_edit(InputKind kind, const Document& document);

/// The step-th edit of a kind other than camera and flight; can_edit() must hold. Odd steps undo even ones,
/// so an even number of them restores the scene, except for the seed.
void apply_edit(InputKind kind, int step, Document& document);

} // namespace candela
