#pragma once
// Tangents along texture coordinates.

#include "core/basis.h"
#include "render/world/surface_interaction.h"

namespace candela {

inline SurfaceTangents tangents_without_uv(vec3 normal) {
  const Basis basis = Basis::from_normal(normal);
  return {basis.s, basis.t, false};
}

/// Of a surface p(a, b) whose coordinates are uv(a, b), from the derivatives of both.
inline SurfaceTangents tangents_from(vec3 dpda, vec3 dpdb, vec2 duv_da, vec2 duv_db, vec3 normal) {
  const float determinant = duv_da.x * duv_db.y - duv_da.y * duv_db.x;
  // Also where the coordinates fold onto a line but for rounding.
  constexpr float kRounding = 1e-6f;
  if (!(std::abs(determinant) > kRounding * glm::length(duv_da) * glm::length(duv_db)))
    return tangents_without_uv(normal);
  const vec3 dpdu = (duv_db.y * dpda - duv_da.y * dpdb) / determinant,
             dpdv = (duv_da.x * dpdb - duv_db.x * dpda) / determinant;
  return {dpdu, dpdv, true};
}

} // namespace candela
