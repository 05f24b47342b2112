#pragma once
// The choice of a material that another one refers to.

#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// The field of a row of FieldType::material: a list of the materials that it may name, which are not those
/// that contain the material itself.
void material_part_field(Ui& ui, ViewerState& state, std::size_t material, const MaterialField& row);

} // namespace candela
