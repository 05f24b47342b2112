#pragma once
// The script of `candela bench interactive`: a flight and edits that are the same in every run.

#include "core/math.h"
#include "scene/document.h"

namespace candela {

enum class InputKind {
  camera,   ///< one movement of the mouse that looks around, then a rest
  flight,   ///< sixty movements a second without rest
  material, ///< of a colour
  light,    ///< of a light's or an emitter's strength
  setting,  ///< of the seed, so that the work stays the same
  object,   ///< of a transform: the geometry is built again
};
inline constexpr InputKind kInputKinds[] = {InputKind::camera, InputKind::flight,  InputKind::material,
                                            InputKind::light,  InputKind::setting, InputKind::object};

const char* to_string(InputKind kind);

/// Where the mouse is at a step of the flight: a figure of eight about the window's middle that no two steps
/// in a row spend at one place; framebuffer pixels.
vec2 flight_position(int step, ivec2 window);

/// Whether the scene has what the kind edits.
bool can_edit(InputKind kind, const Document& document);

/// The step-th edit of a kind, which is neither camera nor flight, of what the scene has most of its kind
/// (can_edit() must hold). Steps go there and back: an even number of them leaves the scene as it was, but
/// for the seed.
void apply_edit(InputKind kind, int step, Document& document);

} // namespace candela
