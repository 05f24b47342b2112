#pragma once
// Mapping between world and screen: the position of a point, and the ray of a mouse position.

#include "app/tools/viewport.h"
#include "render/camera/camera_view.h"

#include <optional>
#include <utility>

namespace candela {

class ScreenProjection {
public:
  /// `picture` is the screen rectangle of a film of `film` pixels. The camera must have no camera_problem().
  ScreenProjection(const Camera& camera, const PixelRect& picture, ivec2 film);

  /// Screen position in framebuffer pixels; nothing for points behind the camera.
  std::optional<vec2> point(vec3 world) const;
  /// The part of a segment in front of the camera, if any.
  std::optional<std::pair<vec2, vec2>> segment(vec3 a, vec3 b) const;
  /// The world-space ray, of unit direction, of a screen position.
  Ray ray(vec2 screen) const;
  /// The film position of a screen position; nothing outside the picture.
  std::optional<vec2> film_position(vec2 screen) const;
  /// Size of a screen pixel in scene units at the depth of a point.
  float units_per_pixel(vec3 world) const;
  vec3 forward() const { return view_.forward(); }
  vec3 right() const { return view_.right(); }
  vec3 up() const { return view_.up(); }
  const PixelRect& picture() const { return picture_; }

private:
  vec2 to_film(vec2 screen) const {
    return (screen - vec2(picture_.x, picture_.y)) * film_ / vec2(picture_.width, picture_.height);
  }

  CameraView view_;
  PixelRect picture_;
  vec2 film_;
  float near_; ///< nearer points are not drawn
};

} // namespace candela
