#include "render/integrators/interior.h"

#include <algorithm>
#include <map>
#include <vector>

namespace candela {

void Interiors::enter(std::uint16_t interior) {
  if (interior == kNoInterior) return;
  if (count_ == bodies_.size()) {
    std::shift_left(bodies_.begin(), bodies_.end(), 1);
    --count_;
  }
  bodies_[count_++] = interior;
}

void Interiors::leave(std::uint16_t interior) {
  for (std::size_t i = count_; i-- > 0;) {
    if (bodies_[i] != interior) continue;
    std::shift_left(bodies_.begin() + static_cast<std::ptrdiff_t>(i), bodies_.begin() + count_, 1);
    --count_;
    return;
  }
}

vec3 transmittance(const RenderScene& scene, const Interiors& interiors, float distance) {
  const std::uint16_t body = interiors.innermost();
  if (body == kNoInterior) return vec3(1);
  const vec3 depth = scene.absorption(body) * distance;
  vec3 passes = glm::exp(-depth);
  for (int c = 0; c < 3; ++c)
    if (std::isnan(depth[c])) passes[c] = 1; // nothing is absorbed on an infinite way
  return passes;
}

namespace {

/// More surfaces in a row than any scene has: coincident ones could catch a ray for ever.
constexpr int kMostSurfaces = 4096;

/// Calls visit(hit's surface, whether the ray comes from its outside, distance from the beginning) at all
/// surfaces along the unit direction.
template <class Visit>
void for_each_surface(const RenderScene& scene, vec3 from, vec3 direction, float distance, Visit visit) {
  Ray ray{from, 0, direction, distance};
  float gone = 0;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const auto hit = scene.geometry().accel().intersect(ray);
    if (!hit) return;
    const Surface s = scene.geometry().surface(ray, *hit);
    gone += hit->t;
    visit(s, glm::dot(s.geometric_normal, direction) < 0, gone);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, direction);
    ray.t_max = distance - gone;
    if (!(ray.t_max > 0)) return;
  }
}

} // namespace

Interiors interiors_at(const RenderScene& scene, vec3 point) {
  // No axes of the scene's: a ray along a wall, or through an edge, would tell nothing.
  constexpr int kPairs = 3;
  const vec3 directions[kPairs] = {glm::normalize(vec3(0.83f, 0.41f, 0.37f)),
                                   glm::normalize(vec3(-0.44f, 0.79f, 0.43f)),
                                   glm::normalize(vec3(-0.29f, -0.47f, 0.84f))};
  /// The n-th body of an interior that a ray leaves without having entered.
  struct Found {
    int rays = 0;
    float nearest = kInfinity;
  };
  std::map<std::pair<std::uint16_t, int>, Found> found;
  for (int k = 0; k < 2 * kPairs; ++k) {
    std::map<std::uint16_t, int> entered, left;
    for_each_surface(scene, point, k < kPairs ? directions[k] : -directions[k - kPairs], kInfinity,
                     [&](const Surface& s, bool from_outside, float distance) {
                       const std::uint16_t interior = scene.material(s.material).interior;
                       if (interior == kNoInterior) return;
                       int& pending = entered[interior];
                       if (from_outside || pending > 0) {
                         pending += from_outside ? 1 : -1;
                         return;
                       }
                       Found& body = found[{interior, left[interior]++}];
                       ++body.rays;
                       body.nearest = std::min(body.nearest, distance);
                     });
  }
  std::vector<std::pair<float, std::uint16_t>> bodies;
  for (const auto& [key, body] : found)
    if (body.rays >= kPairs) bodies.emplace_back(body.nearest, key.first);
  std::ranges::sort(bodies, std::greater<>()); // what is left last is outermost
  Interiors interiors;
  for (const auto& [distance, interior] : bodies) interiors.enter(interior);
  return interiors;
}

void move_between(const RenderScene& scene, vec3 from, vec3 to, Interiors& interiors) {
  const float distance = glm::length(to - from);
  if (!(distance > 0)) return;
  for_each_surface(scene, from, (to - from) / distance, distance,
                   [&](const Surface& s, bool from_outside, float) {
                     interiors.cross(scene.material(s.material).interior, from_outside);
                   });
}

} // namespace candela
