#pragma once
// Which texture a parameter of a material shows, and how.

#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// The field of a material's row, and beside a parameter a thumbnail that opens the list of textures (its
/// widget is "material.KEY.texture": dropping a picture on it makes that the texture).
void material_field(Ui& ui, ViewerState& state, std::size_t material, const MaterialField& row,
                    const FieldContext& context);

/// The key of the parameter whose thumbnail is at the point (framebuffer pixels); empty if none is.
std::string parameter_at(std::span<const WidgetRecord> widgets, vec2 point);

/// Makes the picture the parameter's texture. One that the scene has already is taken from there.
void set_parameter_texture(SceneDesc& scene, const TextureTarget& target,
                           const std::shared_ptr<const Texture>& texture);

} // namespace candela
