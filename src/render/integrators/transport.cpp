#include "render/integrators/transport.h"

namespace candela {

namespace {

/// More transparent surfaces in a row than any scene has end the ray: two coincident ones could catch it for
/// ever.
constexpr std::uint32_t kMaxCrossings = 1024;

/// Of the ray's first `distance` (scene units).
Spectrum transmittance(const RenderScene& scene, const MediumStack& bodies, const Ray& ray, float distance,
                       const Sampler& sampler, Spectrum* unscattered = nullptr) {
  const MediumId id = scene.filling(bodies);
  if (!id) return Spectrum(1);
  const TransmittanceEstimate passes = transmittance(ray, distance, scene.medium(id), sampler);
  if (unscattered != nullptr) *unscattered *= passes.expected;
  return passes.value;
}

/// Whether the surface that the ray, which is in `media`, meets is not there.
bool is_hidden(const RenderScene& scene, const SurfaceMaterial& material, const MediumStack& media,
               const Ray& ray, const Hit& hit) {
  if (material.media.inside.priority <= 0) return false;
  const SurfaceInteraction s = scene.geometry().surface(ray, hit);
  return media.hides(material.media, glm::dot(s.geometric_normal, ray.direction) < 0);
}

} // namespace

bool detail::intersect_through_media(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met,
                                     Hit& hit, RayCounts& counts, MediaPassage* passage,
                                     const ConeOfRay* cone) {
  if (passage != nullptr && passage->way != nullptr) passage->way->start(ray.direction);
  // Behind a surface the ray begins a little beyond it; the medium begins at the surface.
  vec3 begin = ray.origin;
  float skipped = 0;
  auto advance = [&](float distance) {
    if (passage == nullptr) return;
    distance += skipped;
    if (passage->way == nullptr) {
      passage->transmittance *= transmittance(scene, passage->media, ray, distance, sampler);
      return;
    }
    const MediumId id = scene.filling(passage->media);
    passage->way->add(begin, distance, passage->media, id ? &scene.medium(id) : nullptr,
                      id && scene.is_sealed(id));
  };
  if (!scene.has_passable_surfaces()) {
    advance(met ? hit.t : kInfinity);
    return met;
  }
  for (std::uint32_t crossing = 0; met; ++crossing) {
    const SurfaceMaterial& material = scene.material(scene.geometry().material_of(hit));
    advance(hit.t);
    if (passage == nullptr || !is_hidden(scene, material, passage->media, ray, hit)) {
      const float opacity =
          opacity_at(material, [&] { return texture_point(scene, ray, hit, cone, material.asks_place); });
      if (opacity >= 1 || sampler.get_1d(Dimension::opacity, crossing) < opacity) return true;
    }
    if (crossing + 1 == kMaxCrossings) return false;
    SurfaceInteraction s = scene.geometry().surface(ray, hit);
    if (passage != nullptr)
      passage->media.cross(material.media, glm::dot(s.geometric_normal, ray.direction) < 0);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    begin = s.position;
    skipped = glm::dot(ray.origin - begin, ray.direction);
    ++counts.closest;
    met = scene.geometry().accel().intersect(ray, hit);
  }
  advance(kInfinity);
  return false;
}

Spectrum transmittance(const RenderScene& scene, const Ray& towards, const ShadowTarget& target,
                       const Sampler& sampler, RayCounts& counts, const MediumStack* media,
                       Spectrum* unscattered) {
  if (unscattered != nullptr) *unscattered = Spectrum(1);
  const Accel& accel = scene.geometry().accel();
  // `t` is in lengths of the ray's direction, as Hit has it.
  float skipped = 0; // between a surface and where the ray begins behind it
  auto passes = [&](const MediumStack& where, const Ray& ray, float t) {
    return media == nullptr ? Spectrum(1)
                            : transmittance(scene, where, ray, skipped + t * glm::length(ray.direction),
                                            sampler, unscattered);
  };
  const float whole_way = target.infinite ? kInfinity : 1;
  if (!scene.has_passable_surfaces()) {
    ++counts.shadow;
    if (accel.occluded(towards)) return Spectrum(0);
    return passes(media != nullptr ? *media : MediumStack(), towards, whole_way);
  }
  Ray ray = towards;
  MediumStack where = media != nullptr ? *media : MediumStack();
  Spectrum through(1);
  for (std::uint32_t i = 0; i < kMaxCrossings; ++i) {
    ++counts.shadow;
    auto hit = accel.intersect(ray);
    if (!hit) return through * passes(where, ray, whole_way);
    const SurfaceMaterial& material = scene.material(scene.geometry().material_of(*hit));
    if (media == nullptr || !is_hidden(scene, material, where, ray, *hit)) {
      through *= 1 - opacity_at(material, [&] {
                   return texture_point(scene, ray, *hit, nullptr, material.asks_place);
                 });
      if (is_black(through)) return Spectrum(0);
    }
    SurfaceInteraction s = scene.geometry().surface(ray, *hit);
    if (media != nullptr) {
      through *= passes(where, ray, hit->t);
      where.cross(material.media, glm::dot(s.geometric_normal, ray.direction) < 0);
    }
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    if (!target.infinite) ray.direction = target.point - ray.origin;
    skipped = glm::length(ray.origin - s.position);
  }
  return Spectrum(0);
}

bool detail::is_occluded_by_unhidden(const RenderScene& scene, Ray ray, MediumStack media,
                                     RayCounts& counts) {
  for (std::uint32_t i = 0; i < kMaxCrossings; ++i) {
    ++counts.shadow;
    const auto hit = scene.geometry().accel().intersect(ray);
    if (!hit) return false;
    const SurfaceMaterial& material = scene.material(scene.geometry().material_of(*hit));
    if (!material.invisible && !is_hidden(scene, material, media, ray, *hit)) return true;
    const SurfaceInteraction s = scene.geometry().surface(ray, *hit);
    media.cross(material.media, glm::dot(s.geometric_normal, ray.direction) < 0);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    ray.t_max -= hit->t;
    if (!(ray.t_max > 0)) return false;
  }
  return true;
}

} // namespace candela
