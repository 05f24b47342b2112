#pragma once
// Shading normals from textures: normal maps and bump maps. World space; tangents are the derivatives of the
// position by the texture coordinates, and the unit shading normal lies on the side of the geometric one.

#include "core/basis.h"

namespace candela {

/// Around the shading normal: s along dp/du, t to the side of dp/dv. Where the texture is mirrored t is so,
/// too, and the basis is left-handed.
inline Basis texture_basis(vec3 normal, vec3 dpdu, vec3 dpdv) {
  const vec3 along = dpdu - glm::dot(dpdu, normal) * normal;
  const float length2 = length_squared(along);
  if (!(length2 > 0)) return Basis::from_normal(normal);
  const vec3 s = along / std::sqrt(length2), t = glm::cross(normal, s);
  return {s, glm::dot(t, dpdv) < 0 ? -t : t, normal};
}

/// The nearest unit vector to `normal` that is less than 88.9 degrees from the geometric one.
inline vec3 kept_above(vec3 normal, vec3 geometric) {
  constexpr float kLeastCosine = 0.02f;
  const float cosine = glm::dot(normal, geometric);
  if (cosine >= kLeastCosine) return normal;
  const vec3 aside = normal - cosine * geometric;
  const float length2 = length_squared(aside);
  if (!(length2 > 0)) return geometric;
  return glm::normalize(aside * (std::sqrt(1 - sqr(kLeastCosine)) / std::sqrt(length2)) +
                        kLeastCosine * geometric);
}

/// The normal that a texel of a normal map asks for: rgb (linear) is (n + 1) / 2 of a unit normal n in the
/// basis above, green up (as OpenGL and glTF have it). `strength` is a factor of the slopes: 0 is no map.
inline vec3 mapped_normal(const Basis& basis, vec3 geometric, vec3 rgb, float strength = 1) {
  const vec3 n = 2.0f * rgb - 1.0f;
  const vec3 scaled(strength * n.x, strength * n.y, std::max(n.z, 0.0f));
  const float length2 = length_squared(scaled);
  if (!(length2 > 0)) return basis.n;
  return kept_above(basis.to_world(scaled / std::sqrt(length2)), geometric);
}

/// The normal of the surface moved along its normal by a height h, in units of the position, whose
/// derivatives by the texture coordinates are `gradient`:
///     normal - grad h,   grad h = (dh/du (dp/dv x n) + dh/dv (n x dp/du)) / (n . (dp/du x dp/dv))
/// (Blinn 1978, "Simulation of Wrinkled Surfaces", by the surface gradient of Mikkelsen 2010, "Bump Mapping
/// Unparametrized Surfaces on the GPU"). Mirrored textures need no care.
inline vec3 bumped_normal(vec3 normal, vec3 geometric, vec3 dpdu, vec3 dpdv, vec2 gradient) {
  const float area = glm::dot(normal, glm::cross(dpdu, dpdv));
  const vec3 slope = (gradient.x * glm::cross(dpdv, normal) + gradient.y * glm::cross(normal, dpdu)) / area;
  // Without an area, or with a slope without bounds, there is no telling.
  if (area == 0 || !std::isfinite(length_squared(slope))) return normal;
  return kept_above(glm::normalize(normal - slope), geometric);
}

} // namespace candela
