#pragma once
// Placed copies of objects that have a tree of their own. The traversal enters that tree (accel/traversal.h).

#include "accel/primitives/pack.h"

namespace candela {

class Accel;
struct AccelTree;

namespace accel_detail {

// Defined in accel/accel.cpp, which knows what an Accel holds.
Bounds3 object_bounds(const Accel& object);
const AccelTree* object_tree(const Accel& object);

/// A ray in the space of an object, where t stays the same, for the direction is not renormalised.
inline Ray ray_in_object(const glm::mat4x3& object_from_world, const Ray& ray, float t_max) {
  return {object_from_world * vec4(ray.origin, 1), ray.t_min, object_from_world * vec4(ray.direction, 0),
          t_max, ray.time};
}

} // namespace accel_detail

/// The object holds primitives but no instances of its own, is built before and outlives whatever is built
/// from it. The matrix is affine and invertible (a singular one is skipped).
struct InstanceGeometry {
  const Accel* object = nullptr;
  mat4 world_from_object{1};
};

/// A leaf of its own.
struct InstanceRecord {
  const AccelTree* object;
  glm::mat4x3 object_from_world;
  std::uint32_t index; ///< into AccelInput::instances
};

namespace primitives {

struct Instances {
  struct Input {
    std::span<const InstanceGeometry> instances = {};
  };
  using Pack = InstanceRecord;
  static constexpr std::uint32_t kLeafCapacity = 1;
  static constexpr float kLeafCost = 8;

  static std::size_t count(const Input& input) { return input.instances.size(); }

  static Bounds3 bounds(const Input& input, std::size_t i) {
    const InstanceGeometry& instance = input.instances[i];
    if (!instance.object) return {};
    Bounds3 local = accel_detail::object_bounds(*instance.object), result;
    if (local.empty()) return result;
    glm::dmat4 m(instance.world_from_object);
    double determinant = glm::determinant(glm::dmat3(m));
    if (!std::isfinite(determinant) || determinant == 0) return result;
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec4 p(corner & 1 ? local.hi.x : local.lo.x, corner & 2 ? local.hi.y : local.lo.y,
                   corner & 4 ? local.hi.z : local.lo.z, 1);
      vec3 q(m * p);
      if (!accel_detail::usable(q)) return {};
      result.grow(q);
    }
    return accel_detail::padded(result.center(), 0.5f * result.diagonal());
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    const InstanceGeometry& instance = input.instances[primitives[0]];
    const glm::dmat4 inverse = glm::inverse(glm::dmat4(instance.world_from_object));
    pack = {accel_detail::object_tree(*instance.object), glm::mat4x3(mat4(inverse)), primitives[0]};
  }

  static Ray object_ray(const Pack& pack, const Ray& ray, float t_max) {
    return accel_detail::ray_in_object(pack.object_from_world, ray, t_max);
  }
};

} // namespace primitives

} // namespace candela
