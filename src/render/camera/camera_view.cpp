#include "render/camera/camera_view.h"

#include "render/camera/realistic_camera.h"

namespace candela {

float shown_vertical_fov(const Camera& camera, int width, int height) {
  return camera.has_elements() ? RealisticCamera(camera, width, height).vertical_fov() : camera.vertical_fov;
}

} // namespace candela
