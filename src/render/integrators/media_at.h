#pragma once
// Which media a place of the scene is in.

#include "media/medium_stack.h"
#include "render/world/render_scene.h"

namespace candela {

/// What a point lies in. Six rays ask: a body counts where half of them leave it without having entered, so
/// that one that has holes, or a plane that divides space, has an inside, too.
MediumStack media_at(const RenderScene& scene, vec3 point);
/// `media` of `from` become those of `to`.
void move_between(const RenderScene& scene, vec3 from, vec3 to, MediumStack& media);

} // namespace candela
