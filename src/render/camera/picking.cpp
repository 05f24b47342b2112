#include "render/camera/picking.h"

#include "render/camera/camera_view.h"
#include "render/world/render_scene.h"

namespace candela {

namespace {

CameraView view_of(const Document& document) {
  return {document.scene.camera, document.settings.film.width, document.settings.film.height};
}

} // namespace

std::optional<Pick> pick(const RenderScene& scene, const Document& document, vec2 film_position) {
  const CameraView view = view_of(document);
  Ray ray = view.sight(film_position);
  ray.time = document.scene.camera.shutter_open;
  auto hit = scene.geometry().accel().intersect(ray);
  if (!hit) return std::nullopt;
  SurfaceInteraction surface = scene.geometry().surface(ray, *hit);
  Pick p;
  p.position = surface.position;
  p.geometric_normal = glm::dot(surface.geometric_normal, ray.direction) > 0 ? -surface.geometric_normal
                                                                             : surface.geometric_normal;
  p.distance = glm::length(surface.position - ray.origin);
  p.view_depth = glm::dot(surface.position - ray.origin, view.forward());
  p.uv = scene.geometry().uv(ray, *hit);
  p.instance = static_cast<int>(scene.geometry().instance_of(*hit));
  p.material = static_cast<int>(surface.material);
  return p;
}

DepthMap depth_map(const RenderScene& scene, const Document& document, int stride) {
  const CameraView view = view_of(document);
  const FilmSettings& film = document.settings.film;
  DepthMap map{(film.width + stride - 1) / stride, (film.height + stride - 1) / stride, {}};
  map.depth.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      Ray ray = view.sight((vec2(x, y) + 0.5f) * static_cast<float>(stride));
      ray.time = document.scene.camera.shutter_open;
      const auto hit = scene.geometry().accel().intersect(ray);
      map.depth.push_back(hit ? view.view_depth(ray.at(hit->t)) : kInfinity);
    }
  return map;
}

} // namespace candela
