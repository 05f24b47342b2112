#include "render/integrators/media_at.h"

#include <algorithm>
#include <map>
#include <vector>

namespace candela {

namespace {

/// More surfaces in a row than any scene has: coincident ones could catch a ray for ever.
constexpr int kMostSurfaces = 4096;

/// Calls visit(hit's surface, whether the ray comes from its outside, distance from the beginning) at all
/// surfaces along the unit direction.
template <class Visit>
void for_each_surface(const RenderScene& scene, vec3 from, vec3 direction, float distance, float time,
                      Visit visit) {
  Ray ray{from, 0, direction, distance, time};
  float gone = 0;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const auto hit = scene.geometry().accel().intersect(ray);
    if (!hit) return;
    const SurfaceInteraction s = scene.geometry().surface(ray, *hit);
    gone += hit->t;
    visit(s, glm::dot(s.geometric_normal, direction) < 0, gone);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, direction);
    ray.t_max = distance - gone;
    if (!(ray.t_max > 0)) return;
  }
}

} // namespace

MediumStack media_at(const RenderScene& scene, vec3 point, float time) {
  // No axes of the scene's: a ray along a wall, or through an edge, would tell nothing.
  constexpr int kPairs = 3;
  const vec3 directions[kPairs] = {glm::normalize(vec3(0.83f, 0.41f, 0.37f)),
                                   glm::normalize(vec3(-0.44f, 0.79f, 0.43f)),
                                   glm::normalize(vec3(-0.29f, -0.47f, 0.84f))};
  /// The n-th body of a medium that a ray leaves without having entered.
  struct Found {
    int rays = 0;
    float nearest = kInfinity;
  };
  using Key = std::pair<std::uint16_t, std::int16_t>; // of a medium
  auto key = [](MediumId medium) { return Key(medium.index, medium.priority); };
  std::map<std::pair<Key, int>, Found> found;
  for (int k = 0; k < 2 * kPairs; ++k) {
    std::map<Key, int> entered, left;
    for_each_surface(scene, point, k < kPairs ? directions[k] : -directions[k - kPairs], kInfinity, time,
                     [&](const SurfaceInteraction& s, bool from_outside, float distance) {
                       const MediumId inside = scene.material(s.material).media.inside;
                       if (!inside) return;
                       int& pending = entered[key(inside)];
                       if (from_outside || pending > 0) {
                         pending += from_outside ? 1 : -1;
                         return;
                       }
                       Found& body = found[{key(inside), left[key(inside)]++}];
                       ++body.rays;
                       body.nearest = std::min(body.nearest, distance);
                     });
  }
  std::vector<std::pair<float, Key>> bodies;
  for (const auto& [medium, body] : found)
    if (body.rays >= kPairs) bodies.emplace_back(body.nearest, medium.first);
  std::ranges::sort(bodies, std::greater<>()); // what is left last is outermost
  MediumStack media;
  for (const auto& [distance, medium] : bodies) media.enter({medium.first, medium.second});
  return media;
}

void move_between(const RenderScene& scene, vec3 from, vec3 to, MediumStack& media, float time) {
  const float distance = glm::length(to - from);
  if (!(distance > 0)) return;
  for_each_surface(scene, from, (to - from) / distance, distance, time,
                   [&](const SurfaceInteraction& s, bool from_outside, float) {
                     media.cross(scene.material(s.material).media, from_outside);
                   });
}

} // namespace candela
