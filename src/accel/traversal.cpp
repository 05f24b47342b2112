#include "accel/traversal.h"

namespace candela {

namespace {

Ray with_positive_t_min(Ray ray) {
  ray.t_min = std::max(ray.t_min, 0.0f);
  return ray;
}

} // namespace

std::optional<Hit> Accel::intersect(const Ray& ray) const {
  std::optional<Hit> hit;
  if (!tree_ || tree_->empty()) return hit;
  if (!accel_detail::Tracer<simd::Float8, false>::trace(*tree_, with_positive_t_min(ray), hit.emplace()))
    hit.reset();
  return hit;
}

bool Accel::occluded(const Ray& ray) const {
  if (!tree_ || tree_->empty()) return false;
  Hit unused;
  return accel_detail::Tracer<simd::Float8, true>::trace(*tree_, with_positive_t_min(ray), unused);
}

} // namespace candela
