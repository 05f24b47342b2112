#include "render/camera/picking.h"

#include "render/camera/camera_rays.h"
#include "render/world/render_scene.h"

namespace candela {

namespace {

CameraRays pinhole_rays(const Document& document) {
  Camera pinhole = document.scene.camera;
  pinhole.aperture_radius = 0;
  return {pinhole, document.settings.film.width, document.settings.film.height};
}

} // namespace

std::optional<Pick> pick(const RenderScene& scene, const Document& document, vec2 film_position) {
  const CameraRays camera = pinhole_rays(document);
  Ray ray = camera.ray(film_position, vec2(0));
  auto hit = scene.geometry().accel().intersect(ray);
  if (!hit) return std::nullopt;
  SurfaceInteraction surface = scene.geometry().surface(ray, *hit);
  Pick p;
  p.position = surface.position;
  p.geometric_normal = glm::dot(surface.geometric_normal, ray.direction) > 0 ? -surface.geometric_normal
                                                                             : surface.geometric_normal;
  p.distance = glm::length(surface.position - ray.origin);
  p.view_depth = glm::dot(surface.position - ray.origin, camera.forward());
  p.uv = scene.geometry().uv(ray, *hit);
  p.instance = static_cast<int>(scene.geometry().instance_of(*hit));
  p.material = static_cast<int>(surface.material);
  return p;
}

DepthMap depth_map(const RenderScene& scene, const Document& document, int stride) {
  const CameraRays camera = pinhole_rays(document);
  const FilmSettings& film = document.settings.film;
  DepthMap map{(film.width + stride - 1) / stride, (film.height + stride - 1) / stride, {}};
  map.depth.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Ray ray = camera.ray((vec2(x, y) + 0.5f) * static_cast<float>(stride), vec2(0));
      const auto hit = scene.geometry().accel().intersect(ray);
      map.depth.push_back(hit ? hit->t * glm::dot(ray.direction, camera.forward()) : kInfinity);
    }
  return map;
}

} // namespace candela
