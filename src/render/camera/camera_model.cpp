#include "render/camera/camera_model.h"

#include "render/camera/realistic_camera.h"
#include "render/camera/spherical_camera.h"
#include "render/camera/thin_lens_camera.h"

namespace candela {

std::shared_ptr<const CameraModel> make_camera(const Camera& camera, int width, int height) {
  if (camera.projection == Projection::spherical)
    return std::make_shared<const SphericalCamera>(camera, width, height);
  if (camera.has_elements()) return std::make_shared<const RealisticCamera>(camera, width, height);
  return std::make_shared<const ThinLensCamera>(camera, width, height);
}

} // namespace candela
