#pragma once
// Copies of objects that move while the shutter is open: the ray's time tells where they are.

#include "accel/primitives/instances.h"
#include "core/moving_transform.h"

namespace candela {

/// The object as that of an InstanceGeometry.
struct MovingInstanceGeometry {
  const Accel* object = nullptr;
  MovingTransform placement;
};

/// Hit::instance of moving instances is their index with this bit, which no index of others reaches.
inline constexpr std::uint32_t kMovingInstance = 1u << 31;

/// A leaf of its own.
struct MovingInstanceRecord {
  const AccelTree* object;
  MovingTransform placement;
  std::uint32_t index; ///< Hit::instance
};

namespace accel_detail {

/// As of an instance that stands still where the moving one is at that time, placed in single precision.
inline glm::mat4x3 object_from_world(const MovingTransform& placement, float time) {
  const mat4 placed(placement.at(static_cast<double>(time)));
  return glm::mat4x3(mat4(glm::inverse(glm::dmat4(placed))));
}

} // namespace accel_detail

namespace primitives {

struct MovingInstances {
  struct Input {
    std::span<const MovingInstanceGeometry> moving_instances = {};
  };
  using Pack = MovingInstanceRecord;
  static constexpr std::uint32_t kLeafCapacity = 1;
  static constexpr float kLeafCost = 10;

  static std::size_t count(const Input& input) { return input.moving_instances.size(); }

  /// Of all times.
  static Bounds3 bounds(const Input& input, std::size_t i) {
    const MovingInstanceGeometry& instance = input.moving_instances[i];
    if (!instance.object) return {};
    const double determinant = glm::determinant(glm::dmat3(instance.placement.world_from_object));
    if (!std::isfinite(determinant) || determinant == 0) return {};
    const Bounds3 box = instance.placement.bounds(accel_detail::object_bounds(*instance.object));
    if (box.empty() || !accel_detail::usable(box.lo) || !accel_detail::usable(box.hi)) return {};
    return accel_detail::padded(box.center(), 0.5f * box.diagonal());
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    const MovingInstanceGeometry& instance = input.moving_instances[primitives[0]];
    pack = {accel_detail::object_tree(*instance.object), instance.placement, primitives[0] | kMovingInstance};
  }

  static Ray object_ray(const Pack& pack, const Ray& ray, float t_max) {
    return accel_detail::ray_in_object(accel_detail::object_from_world(pack.placement, ray.time), ray, t_max);
  }
};

} // namespace primitives

} // namespace candela
