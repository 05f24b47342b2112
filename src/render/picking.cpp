#include "render/picking.h"

#include "render/camera_rays.h"
#include "render/render_scene.h"

namespace candela {

std::optional<Pick> pick(const RenderScene& scene, const Document& document, vec2 film_position) {
  Camera pinhole = document.scene.camera;
  pinhole.aperture_radius = 0;
  CameraRays camera(pinhole, document.settings.film.width, document.settings.film.height);
  Ray ray = camera.ray(film_position, vec2(0));
  auto hit = scene.geometry().accel().intersect(ray);
  if (!hit) return std::nullopt;
  Surface surface = scene.geometry().surface(ray, *hit);
  Pick p;
  p.position = surface.position;
  p.geometric_normal = glm::dot(surface.geometric_normal, ray.direction) > 0 ? -surface.geometric_normal
                                                                             : surface.geometric_normal;
  p.distance = glm::length(surface.position - ray.origin);
  p.view_depth = glm::dot(surface.position - ray.origin, camera.forward());
  p.instance = static_cast<int>(scene.geometry().instance_of(*hit));
  p.material = static_cast<int>(surface.material);
  return p;
}

} // namespace candela
