#include "accel/packet.h"

namespace candela {

namespace {

/// Calls each(i, trace) for every ray, where trace(hit) says whether it meets something.
template <bool any_hit, class Function>
void trace_in_packets(const AccelTree& tree, std::span<const Ray* const> rays, Function&& each) {
  for (std::size_t begin = 0; begin < rays.size(); begin += accel_detail::kPacketSize) {
    const auto packet = rays.subspan(begin, std::min(accel_detail::kPacketSize, rays.size() - begin));
    const auto points = accel_detail::find_entry_points<simd::Float8>(tree, packet);
    for (std::size_t i = begin; i < begin + packet.size(); ++i)
      each(i, [&](Hit& hit) {
        return accel_detail::trace_from<simd::Float8, any_hit>(tree, points, *rays[i], hit);
      });
  }
}

} // namespace

std::optional<Hit> Accel::intersect(const Ray& ray) const {
  std::optional<Hit> hit;
  if (!intersect(ray, hit.emplace())) hit.reset();
  return hit;
}

bool Accel::intersect(const Ray& ray, Hit& hit) const {
  return tree_ && !tree_->empty() && accel_detail::trace<simd::Float8, false>(*tree_, ray, hit);
}

void Accel::intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const {
  if (!tree_ || tree_->empty()) {
    for (Hit& hit : hits.first(rays.size())) hit.t = kInfinity;
    return;
  }
  trace_in_packets<false>(*tree_, rays, [&](std::size_t i, auto&& trace) {
    if (!trace(hits[i])) hits[i].t = kInfinity;
  });
}

bool Accel::occluded(const Ray& ray) const {
  if (!tree_ || tree_->empty()) return false;
  Hit unused;
  return accel_detail::trace<simd::Float8, true>(*tree_, ray, unused);
}

void Accel::occluded(std::span<const Ray* const> rays, std::span<bool> result) const {
  if (!tree_ || tree_->empty()) {
    std::fill_n(result.begin(), rays.size(), false);
    return;
  }
  trace_in_packets<true>(*tree_, rays, [&](std::size_t i, auto&& trace) {
    Hit unused;
    result[i] = trace(unused);
  });
}

TraversalCost Accel::cost(const Ray& ray) const {
  TraversalCost cost;
  if (!tree_ || tree_->empty()) return cost;
  Hit unused;
  accel_detail::trace<simd::Float8, false>(*tree_, ray, unused, cost);
  return cost;
}

} // namespace candela
