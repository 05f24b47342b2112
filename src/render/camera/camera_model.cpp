#include "render/camera/camera_model.h"

#include "render/camera/realistic_camera.h"
#include "render/camera/spherical_camera.h"
#include "render/camera/stereo_camera.h"
#include "render/camera/thin_lens_camera.h"

namespace candela {

namespace {

std::shared_ptr<const CameraModel> make_single_camera(const Camera& camera, int width, int height) {
  if (camera.projection == Projection::spherical)
    return std::make_shared<const SphericalCamera>(camera, width, height);
  if (camera.has_elements()) return std::make_shared<const RealisticCamera>(camera, width, height);
  return std::make_shared<const ThinLensCamera>(camera, width, height);
}

} // namespace

std::shared_ptr<const CameraModel> make_camera(const Camera& camera, int width, int height) {
  if (camera.stereo == Stereo::none) return make_single_camera(camera, width, height);
  Camera between = camera;
  between.stereo = Stereo::none;
  const ivec2 size = StereoPanes(camera.stereo, width, height).size;
  return std::make_shared<const StereoCamera>(camera, width, height,
                                              make_single_camera(between, size.x, size.y));
}

} // namespace candela
