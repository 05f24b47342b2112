#include "accel/traversal.h"

namespace candela {

std::optional<Hit> Accel::intersect(const Ray& ray) const {
  std::optional<Hit> hit;
  if (!intersect(ray, hit.emplace())) hit.reset();
  return hit;
}

bool Accel::intersect(const Ray& ray, Hit& hit) const {
  return tree_ && !tree_->empty() && accel_detail::trace<simd::Float8, false>(*tree_, ray, hit);
}

bool Accel::occluded(const Ray& ray) const {
  if (!tree_ || tree_->empty()) return false;
  Hit unused;
  return accel_detail::trace<simd::Float8, true>(*tree_, ray, unused);
}

TraversalCost Accel::cost(const Ray& ray) const {
  TraversalCost cost;
  if (!tree_ || tree_->empty()) return cost;
  Hit unused;
  accel_detail::trace<simd::Float8, false>(*tree_, ray, unused, cost);
  return cost;
}

} // namespace candela
