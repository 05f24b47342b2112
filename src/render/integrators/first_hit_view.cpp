#include "render/integrators/first_hit_view.h"

namespace candela {

namespace {

/// Colours of neighbouring indices lie far apart on the hue circle (steps of the golden ratio), of middling
/// lightness, so that any two meet in an edge.
vec3 index_color(std::uint32_t index) {
  float turn = static_cast<float>(index) * 0.6180339887f;
  vec3 hue = 2 * kPi * (vec3(turn - std::floor(turn)) + vec3(0, 1.0f / 3, 2.0f / 3));
  float lightness = index % 2 == 0 ? 0.5f : 0.3f;
  return lightness * (1.0f + 0.7f * glm::cos(hue));
}

vec3 towards_viewer(vec3 normal, const SurfaceInteraction& surface, const Ray& ray) {
  return 0.5f * (glm::dot(surface.geometric_normal, ray.direction) > 0 ? -normal : normal) + 0.5f;
}

/// The mean of the channels; of grids an estimate, by a place in each brick.
float optical_depth_of(const MediumWay& way, const Sampler& sampler) {
  float depth = 0;
  for (const MediumSegment& segment : way.segments()) {
    if (segment.medium == nullptr) continue;
    TrackingRandom random(sampler, segment.origin, way.direction());
    depth += average(visit_variant(
        [&](const auto& medium) {
          return medium.estimate_optical_depth(segment.origin, way.direction(), segment.end - segment.begin,
                                               random);
        },
        *segment.medium));
  }
  return std::min(depth, kGreatestOpticalDepth);
}

} // namespace

Spectrum bvh_cost_value(const RenderScene& scene, const Ray& ray, RayCounts& counts) {
  ++counts.closest;
  const TraversalCost cost = scene.geometry().accel().cost(ray);
  return vec3(static_cast<float>(cost.nodes + cost.packs));
}

Spectrum first_hit_value(const RenderScene& scene, Ray ray, const MediumStack& media, bool met, Hit hit,
                         vec3 forward, View view, Sampler& sampler, RayCounts& counts,
                         const ConeOfRay* cone) {
  const vec3 origin = ray.origin;
  sampler.set_bounce(1);
  MediaPassage passage{media, Spectrum(1)};
  MediumWay way(true);
  const bool asks_depth = view == View::optical_depth && scene.has_media();
  if (asks_depth) passage.way = &way;
  met = intersect_through_opacity(scene, ray, sampler, met, hit, counts,
                                  asks_depth || scene.has_priorities() ? &passage : nullptr, cone);
  if (asks_depth) return vec3(optical_depth_of(way, sampler));
  if (!met) return vec3(0);
  SurfaceInteraction surface = scene.geometry().surface(ray, hit);
  const bool outside = glm::dot(surface.geometric_normal, ray.direction) < 0;
  const SurfaceMaterial& material = facing(scene.material(surface.material), outside);
  auto uv = [&] { return scene.geometry().uv(ray, hit); };
  switch (view) {
  case View::albedo: {
    BlendArena blends;
    Bsdf bsdf =
        material.textured
            ? evaluate_bsdf(material, texture_point(scene, ray, hit, cone, material.asks_place), blends)
            : material.bsdf;
    set_outside(scene, material, passage.media, outside, bsdf);
    return bsdf_albedo(bsdf);
  }
  case View::normal:
    return towards_viewer(shading_normal_at(material, scene, ray, hit, surface, cone), surface, ray);
  case View::geometric_normal: return towards_viewer(surface.geometric_normal, surface, ray);
  case View::depth: return vec3(glm::dot(surface.position - origin, forward));
  case View::optical_depth: return vec3(0); // there are no media
  case View::uv: return vec3(uv() - glm::floor(uv()), 0);
  case View::material: return index_color(surface.material);
  default: return vec3(0);
  }
}

} // namespace candela
