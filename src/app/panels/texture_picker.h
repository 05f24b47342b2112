#pragma once
// The choice of a parameter's texture, and how it is used.

#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// The field of a material's row; next to a parameter, a thumbnail that opens the list of textures. A picture
/// dropped on the thumbnail (widget "material.KEY.texture") becomes the texture.
void material_field(Ui& ui, ViewerState& state, std::size_t material, const MaterialField& row,
                    const FieldContext& context);

/// The key of the parameter whose thumbnail is at the point (framebuffer pixels); empty if there is none.
std::string parameter_at(std::span<const WidgetRecord> widgets, vec2 point);

/// Makes the picture the parameter's texture; an existing texture of the scene with the same picture is
/// reused.
void set_parameter_texture(SceneDesc& scene, const TextureTarget& target,
                           const std::shared_ptr<const Texture>& texture);

} // namespace candela
