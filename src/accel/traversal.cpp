#include "accel/packet.h"

namespace candela {

namespace {

/// Calls each(packet, index of its first ray, number of its rays).
template <class Function>
void for_each_packet(const AccelTree& tree, std::span<const Ray* const> rays, Function&& each) {
  for (std::size_t begin = 0; begin < rays.size(); begin += accel_detail::kPacketSize) {
    const std::size_t count = std::min(accel_detail::kPacketSize, rays.size() - begin);
    each(accel_detail::Packet<simd::Float8>(tree, rays.subspan(begin, count)), begin, count);
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
  for_each_packet(*tree_, rays, [&](const auto& packet, std::size_t begin, std::size_t count) {
    packet.intersect(hits.subspan(begin, count));
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
  for_each_packet(*tree_, rays, [&](const auto& packet, std::size_t begin, std::size_t count) {
    packet.occluded(result.subspan(begin, count));
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
