#include "app/tools/projection.h"

namespace candela {

ScreenProjection::ScreenProjection(const Camera& camera, const PixelRect& picture, ivec2 film)
    : view_(camera, film.x, film.y), picture_(picture), film_(film),
      near_(1e-4f * glm::length(camera.target - camera.position)) {
  picture_.width = std::max(picture_.width, 1);
  picture_.height = std::max(picture_.height, 1);
}

std::optional<vec2> ScreenProjection::point(vec3 world) const {
  if (!(view_.view_depth(world) >= near_)) return std::nullopt;
  const std::optional<vec2> film = view_.project(world);
  if (!film) return std::nullopt;
  return vec2(picture_.x, picture_.y) + *film * vec2(picture_.width, picture_.height) / film_;
}

std::optional<std::pair<vec2, vec2>> ScreenProjection::segment(vec3 a, vec3 b) const {
  const float depth_a = view_.view_depth(a), depth_b = view_.view_depth(b);
  if (!(depth_a > near_) && !(depth_b > near_)) return std::nullopt;
  // Slightly in front of the near plane, so that rounding does not discard the clipped end.
  const vec3 cut = glm::mix(a, b, (1.001f * near_ - depth_a) / (depth_b - depth_a));
  const auto from = point(depth_a > near_ ? a : cut), to = point(depth_b > near_ ? b : cut);
  if (!from || !to) return std::nullopt;
  // Past the back of a view of all directions, from one edge of the picture to the other.
  if (view_.spherical() && std::abs(from->x - to->x) > 0.5f * static_cast<float>(picture_.width))
    return std::nullopt;
  return std::pair(*from, *to);
}

Ray ScreenProjection::ray(vec2 screen) const { return view_.sight(to_film(screen)); }

std::optional<vec2> ScreenProjection::film_position(vec2 screen) const {
  const vec2 at = to_film(screen + 0.5f); // centre of the screen pixel
  if (at.x < 0 || at.y < 0 || at.x >= film_.x || at.y >= film_.y) return std::nullopt;
  return at;
}

float ScreenProjection::units_per_pixel(vec3 world) const {
  return view_.pixel_footprint(std::max(view_.view_depth(world), near_)).y * film_.y /
         static_cast<float>(picture_.height);
}

} // namespace candela
