#pragma once
// Which media a place of the scene is in.

#include "media/medium_stack.h"
#include "render/world/render_scene.h"

namespace candela {

/// What a point lies in. Six rays ask: a body counts where half of them leave it without having entered, so
/// that one that has holes, or a plane that divides space, has an inside, too.
MediumStack media_at(const RenderScene& scene, vec3 point, float time = 0);
/// `media` of `from` become those of `to`, at the same time.
void move_between(const RenderScene& scene, vec3 from, vec3 to, MediumStack& media, float time = 0);

/// The media of points near one, as those of a lens are: found once for that one, where nothing moves. None
/// in scenes without any.
class MediaNear {
public:
  /// Refers to the scene, which must outlive it.
  MediaNear(const RenderScene& scene, vec3 point)
      : scene_(scene), point_(point), media_(scene.has_media() ? media_at(scene, point) : MediumStack()) {}

  MediumStack at(vec3 near, float time) const {
    if (!scene_.has_media()) return media_;
    if (scene_.geometry().moves()) return media_at(scene_, near, time);
    MediumStack media = media_;
    move_between(scene_, point_, near, media, time);
    return media;
  }

private:
  const RenderScene& scene_;
  vec3 point_;
  MediumStack media_;
};

} // namespace candela
