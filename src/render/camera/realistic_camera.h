#pragma once
// A camera behind a lens of many elements (lens_system.h).

#include "render/camera/camera_model.h"
#include "render/camera/camera_view.h"
#include "render/camera/lens_system.h"
#include "render/camera/lenses.h"

namespace candela {

struct RealisticCameraSettings {
  float focal_length = 0;      ///< millimetres; 0: the prescription's own
  float f_stop = 0;            ///< 0: wide open
  float sensor_diagonal = 35;  ///< millimetres
  float units_per_mm = 0.001f; ///< scene units a millimetre; the default is a scene in metres
};

/// The camera's position is the middle of the entrance pupil, from which a lens sees its perspective, so that
/// focus_distance means what it means for ThinLensCamera; rays begin on the first interface. The field of
/// view follows from the lens and the film, whose shape is the view's: Camera::vertical_fov,
/// aperture_radius and projection have no effect.
///
/// A pixel in the film's middle gets the radiance that it sees (what ThinLensCamera shows) if the lens is
/// focused at infinity, whatever its f-number: exposure is undone. Off the axis the picture darkens by
/// cos^4 and vignetting and, with a nearer focus, by the bellows factor, as a photograph does.
class RealisticCamera final : public CameraModel {
public:
  RealisticCamera(const Camera& camera, int width, int height, const LensPrescription& lens,
                  const RealisticCameraSettings& settings = {})
      : view_(pose_of(camera), width, height), units_per_mm_(settings.units_per_mm),
        center_(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
        pixel_(pixel_size(camera, width, height, settings.sensor_diagonal)),
        lens_(LensSystem::shared(lens.interfaces, setup(camera, lens, settings,
                                                        glm::length(pixel_ * (center_ + kFilterReach))))) {}

  /// With the lens and the settings of the camera, which has elements.
  RealisticCamera(const Camera& camera, int width, int height)
      : RealisticCamera(camera, width, height, kLenses[static_cast<std::size_t>(camera.lens) - 1],
                        {0, camera.f_stop, camera.sensor_diagonal, camera.units_per_mm}) {}

  const LensSystem& lens() const { return *lens_; }
  vec2 pixel_on_film() const { return pixel_; } ///< its sides, in millimetres

  /// Of the paraxial view: what a thin lens in its place needs to show as much. The chief ray through the
  /// middles of the pupils: its tangents are inversely as their radii (the invariant of Lagrange).
  float vertical_fov() const {
    const LensSystem::Pupil &entrance = lens_->entrance_pupil(), &exit = lens_->exit_pupil();
    const double half = static_cast<double>(pixel_.y * center_.y);
    const double tangent =
        std::isfinite(exit.z)
            ? half / (static_cast<double>(lens_->film_distance()) + exit.z) * exit.radius / entrance.radius
            : half / lens_->focal_length();
    return static_cast<float>(2 * std::atan(tangent));
  }

  bool uses_lens_sample() const override { return true; }

  std::optional<float> generate(vec2 film, vec2 u_lens, Ray& ray) const override {
    const vec2 shift = (film - center_) * pixel_;
    const vec2 at(-shift.x, shift.y); // the image stands on its head; pixel rows go down
    const auto pupil = lens_->sample_exit_pupil(at, u_lens);
    if (!pupil) return std::nullopt;
    const vec3 from(at, -lens_->film_distance());
    const auto out = lens_->trace_from_film({from, glm::normalize(vec3(pupil->point, 0) - from)});
    if (!out) return std::nullopt;
    const vec3 p = (out->origin - vec3(0, 0, lens_->entrance_pupil().z)) * units_per_mm_;
    ray = {view_.position() + to_world(p), 0, glm::normalize(to_world(out->direction)), kInfinity};
    return lens_->sample_weight(at, *pupil);
  }

private:
  static constexpr float kFilterReach = 8.5f; ///< pixels that a filter reaches beyond the film's edge

  /// For its axes alone.
  static Camera pose_of(Camera camera) {
    camera.lens = Lens::thin;
    return camera;
  }
  static vec2 pixel_size(const Camera& camera, int width, int height, float diagonal) {
    const vec2 size(width, height);
    const float aspect = camera.aspect > 0 ? camera.aspect : size.x / size.y;
    return diagonal / std::sqrt(1 + sqr(aspect)) * vec2(aspect, 1) / size;
  }
  static LensSetup setup(const Camera& camera, const LensPrescription& lens, const RealisticCameraSettings& s,
                         float film_radius) {
    return {s.focal_length > 0 ? s.focal_length : lens.focal_length,
            s.f_stop,
            camera.effective_focus_distance() / s.units_per_mm,
            film_radius,
            camera.blades,
            camera.blade_rotation};
  }

  vec3 to_world(vec3 v) const { return view_.right() * v.x + view_.up() * v.y + view_.forward() * v.z; }

  CameraView view_;
  float units_per_mm_;
  vec2 center_, pixel_; ///< pixel_: its sides on the film, in millimetres
  std::shared_ptr<const LensSystem> lens_;
};

} // namespace candela
