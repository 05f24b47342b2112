#pragma once
// The choice of a material that another one refers to.

#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// Draws the thumbnail of a material of the scene, or its place until there is one.
void draw_material_thumbnail(ViewerState& state, std::size_t material, vec2 lo, vec2 hi);

/// The field of a row of FieldType::material: a list of the materials that it may name, which are not those
/// that contain the material itself.
void material_part_field(Ui& ui, ViewerState& state, std::size_t material, const MaterialField& row);

} // namespace candela
