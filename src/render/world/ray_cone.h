#pragma once
// How much of a surface a ray stands for, so that textures can be filtered: ray cones (Amanatides 1984, "Ray
// Tracing with Cones"; Akenine-Möller et al. 2021, "Improved Shader and Texture Level of Detail Using Ray
// Cones").

#include "render/world/surface_interaction.h"
#include "textures/texture_point.h"

namespace candela {

/// The circular cone about a ray of unit direction. Two numbers, which grow by addition along a path: cheaper
/// than ray differentials (Igehy 1999), and no coarser where a path has scattered.
struct RayCone {
  float width = 0;  ///< diameter at the ray's origin, scene units
  float spread = 0; ///< growth of the diameter by distance: the angle of the cone, if small

  /// Of the square that a pixel covers, by its side at the camera and at the distance 1 from it
  /// (Camera::pixel_footprint).
  static RayCone of_pixel(float side_at_camera, float side_at_distance_1) {
    return {side_at_camera, side_at_distance_1 - side_at_camera};
  }

  float width_at(float distance) const { return width + spread * distance; }
  /// Of a ray that leaves a surface at that distance, spread by so much more: 0 for a flat mirror, about the
  /// width of the lobe for a rough one.
  RayCone after(float distance, float more_spread) const {
    return {width_at(distance), spread + more_spread};
  }
};

/// What a rough surface adds to the spread of a path that it scatters with this density of its BSDF, 1/sr:
/// the cones of 16 such paths fill the lobe. As by Suykens and Willems 2001, "Path Differentials and
/// Applications", a footprint is what a sample has to itself; the number is a guess at how many paths of a
/// pixel go this way. The BSDF's own density, whatever directions are sampled by, so that the mean of a
/// picture does not depend on that.
inline float lobe_spread(float pdf) {
  constexpr float kPaths = 16, kMost = 0.5f;
  return pdf > 0 ? std::min(2 / std::sqrt(kPi * kPaths * pdf), kMost) : kMost;
}

/// The cone of a ray that may have passed transparent surfaces since, and so begin elsewhere.
struct ConeOfRay {
  RayCone cone;
  vec3 origin{0};

  float width_at(vec3 point) const { return cone.width_at(glm::length(point - origin)); }
  /// Of the ray that leaves `point`, see RayCone::after.
  ConeOfRay after(vec3 point, float more_spread) const {
    return {cone.after(glm::length(point - origin), more_spread), point};
  }
};

/// Of a cone `width` wide about the unit `direction`, on a surface with that unit geometric normal. In scene
/// units the axes are width / |cos| along the direction's projection and `width` across it; at grazing angles
/// the major one is cut. Nothing where the surface has no coordinates.
inline UvFootprint uv_footprint(vec3 direction, vec3 normal, float width, const SurfaceTangents& tangents) {
  constexpr float kLeastCosine = 1e-3f;
  if (!tangents.has_uv) return {};
  const float cosine = glm::dot(direction, normal);
  vec3 along = direction - cosine * normal;
  const float sine = glm::length(along);
  along = sine > 1e-6f ? along / sine : glm::normalize(tangents.dpdu);
  const vec3 across = glm::cross(normal, along);
  // A tangent vector a = dpdu x + dpdv y, by the normal equations.
  const float uu = glm::dot(tangents.dpdu, tangents.dpdu), uv = glm::dot(tangents.dpdu, tangents.dpdv),
              vv = glm::dot(tangents.dpdv, tangents.dpdv), determinant = uu * vv - uv * uv;
  auto coordinates = [&](vec3 a) {
    const float au = glm::dot(a, tangents.dpdu), av = glm::dot(a, tangents.dpdv);
    return vec2(vv * au - uv * av, uu * av - uv * au) / determinant;
  };
  return {coordinates(along * (width / std::max(std::abs(cosine), kLeastCosine))),
          coordinates(across * width)};
}

} // namespace candela
