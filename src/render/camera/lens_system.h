#pragma once
// Light through a lens of many elements, traced from interface to interface (Kolb, Mitchell and Hanrahan
// 1995, "A Realistic Camera Model for Computer Graphics"; pbrt, "Realistic Cameras"). Coatings are ideal:
// nothing is lost at an interface but by its clear opening.

#include "core/math.h"
#include "render/camera/exit_pupil.h"
#include "render/camera/lens_interface.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace candela {

/// What the photographer sets. Lengths in millimetres.
struct LensSetup {
  float focal_length = 0;           ///< to which the table is scaled; 0: it stays as it is
  float f_stop = 0;                 ///< focal length over the diameter of the entrance pupil; 0: wide open
  float focus_distance = kInfinity; ///< along the axis from the entrance pupil to the plane in focus
  float film_radius = 17.5f;        ///< the farthest from the axis that film positions lie
  int blades = 0;                   ///< of the stop, as class Aperture has them
  float blade_rotation = 0;         ///< radians
  bool operator==(const LensSetup&) const = default;
};

/// Unit direction. In lens space: z is the axis and points at the scene, 0 is the vertex of the last
/// interface, the film is the plane z = -film_distance(). Millimetres.
struct LensRay {
  vec3 origin, direction;
};

class LensSystem {
public:
  /// Throws std::invalid_argument where lens_problem() finds one.
  LensSystem(std::span<const LensInterface> table, const LensSetup& setup);

  /// The same, which takes some ten milliseconds, or one of the last few that are equal: a picture is
  /// rendered in many passes, each of which makes its camera.
  static std::shared_ptr<const LensSystem> shared(std::span<const LensInterface> table,
                                                  const LensSetup& setup);

  /// Paraxial, in lens space (z of planes). The focal lengths are the same on both sides, for air is.
  struct CardinalPoints {
    double focal_length;
    double front_principal, rear_principal, front_focus, rear_focus;
  };
  /// The paraxial image of the stop, seen from the scene (entrance) or from the film (exit).
  struct Pupil {
    double z, radius; ///< z is infinite where the side is telecentric
  };
  const CardinalPoints& cardinal_points() const { return cardinal_; }
  const Pupil& entrance_pupil() const { return entrance_pupil_; }
  const Pupil& exit_pupil() const { return exit_pupil_; }

  double focal_length() const { return cardinal_.focal_length; }
  float f_number() const { return f_number_; }               ///< as the stop is set
  float widest_f_number() const { return widest_f_number_; } ///< of the table's stop
  float stop_diameter() const { return 2 * stop_radius_; }
  float front_vertex() const { return front_vertex_; } ///< z of the first interface
  float film_distance() const { return film_distance_; }
  /// What it is focused at, from the entrance pupil: the distance asked for or, if that is nearer, the one
  /// at which the image is half as large as the object.
  float focus_distance() const { return focus_distance_; }
  float film_radius() const { return film_radius_; }

  /// Where the light that reaches a film point from a direction came from; nothing where the lens stops it.
  /// The ray begins on the film's side of the last interface and points to the scene; so does the result,
  /// which begins on the first interface.
  std::optional<LensRay> trace_from_film(const LensRay& ray) const;
  /// The way back: from the scene to the last interface, both pointing at the film.
  std::optional<LensRay> trace_from_scene(const LensRay& ray) const;
  /// The points at the interfaces, for drawing; the last one where it is stopped.
  std::vector<vec3> path_from_film(const LensRay& ray) const;

  /// A point of the plane z = 0, uniform over an ellipse around what of it the film point sees the scene
  /// through, and the ellipse's area. Nothing where it sees none.
  struct PupilSample {
    vec2 point;
    float area;
  };
  std::optional<PupilSample> sample_exit_pupil(vec2 film, vec2 u) const;

  /// The ellipse itself, of film points on the +x axis.
  PupilEllipse exit_pupil_bounds(float film_radius) const { return pupils_.at(film_radius); }

  /// Irradiance of the film per radiance of a scene that is the same everywhere, at the middle of the film
  /// when it is focused at infinity: pi sin^2 of the marginal ray's angle. It is pi / (4 f_number^2) for a
  /// lens that fulfils the sine condition.
  float axial_exposure() const { return axial_exposure_; }
  /// Kolb et al., eq. 2: the irradiance that a sample stands for, cos^4(theta) area / film_distance^2, over
  /// axial_exposure(), with theta the angle between the axis and the line from the film to the pupil.
  float sample_weight(vec2 film, const PupilSample& sample) const {
    const float d2 = sqr(film_distance_);
    const float cos2 = d2 / (d2 + glm::dot(sample.point - film, sample.point - film));
    return sqr(cos2) * sample.area / (d2 * axial_exposure_);
  }
  /// The share of axial_exposure() that a point at that distance from the film's middle gets: vignetting, by
  /// the cosines and by the openings of the elements.
  double relative_illumination(float film_radius) const;

  /// From the film to the scene.
  std::span<const LensSurface<float>> surfaces() const { return surfaces_; }

private:
  bool through_blades(float x, float y) const;
  template <bool to_scene>
  std::optional<LensRay> trace(LensRay ray, std::vector<vec3>* path) const;

  std::vector<LensSurface<float>> surfaces_;
  std::vector<vec2> blade_normals_;
  float blade_distance_ = 0; ///< of the stop's sides from its middle
  CardinalPoints cardinal_{};
  Pupil entrance_pupil_{}, exit_pupil_{};
  float f_number_ = 0, widest_f_number_ = 0, stop_radius_ = 0, front_vertex_ = 0;
  float film_distance_ = 0, focus_distance_ = 0, film_radius_ = 0, axial_exposure_ = 1;
  ExitPupils pupils_;
};

/// Why a table is no lens that forms an image; empty if all is well.
std::string lens_problem(std::span<const LensInterface> table);

} // namespace candela
