#pragma once
// Vectors for Dear ImGui.

#include "core/math.h"

#include <imgui.h>

namespace candela {

inline ImVec2 im(vec2 v) { return {v.x, v.y}; }

} // namespace candela
