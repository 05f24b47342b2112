#include "render/camera/camera_model.h"

#include "render/camera/thin_lens_camera.h"

namespace candela {

std::shared_ptr<const CameraModel> make_camera(const Camera& camera, int width, int height) {
  return std::make_shared<const ThinLensCamera>(camera, width, height);
}

} // namespace candela
