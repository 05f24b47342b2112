#pragma once
// The scene description: values that are cheap to copy (bulk data is shared), edited by the UI and the
// command line.

#include "core/bounds.h"
#include "core/fields.h"
#include "lights/light_desc.h"
#include "materials/material.h"
#include "media/medium_desc.h"
#include "scene/curves.h"
#include "scene/light_group.h"
#include "scene/mesh.h"
#include "scene/motion.h"
#include "textures/texture.h"

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace candela {

enum class Projection : int { perspective, orthographic, spherical };
/// The lens of a perspective camera: a thin one, or one of render/camera/lenses.h.
enum class Lens : int { thin, double_gauss, wide_angle, telephoto, fisheye };

/// Where the film holds a picture for each eye.
enum class Stereo : int { none, side_by_side, top_bottom };

/// A pinhole, or a thin lens when aperture_radius > 0.
struct Camera {
  vec3 position{0, 0, 5};
  vec3 target{0, 0, 0};
  vec3 up{0, 1, 0};
  float vertical_fov = radians(45.0f); ///< radians, of the full image height
  Projection projection = Projection::perspective;
  static constexpr float kGreatestHeight = 1e9f;
  float orthographic_height = 2; ///< scene units, of the full image height
  float aspect = 0;              ///< width over height of the view; 0: that of the film, pixels are square
  float aperture_radius = 0;     ///< scene units; 0: pinhole
  int blades = 0;                ///< sides of the aperture's polygon; below 3: round
  float blade_rotation = 0;      ///< radians
  float focus_distance = 0;      ///< scene units along the view axis; 0: the distance to the target
  Lens lens = Lens::thin;
  float f_stop = 0;            ///< of a lens of elements; 0: wide open
  float sensor_diagonal = 35;  ///< mm, of the film behind such a lens
  float units_per_mm = 0.001f; ///< scene units a millimetre of such a lens
  Stereo stereo = Stereo::none;
  float interocular_distance = 0.065f; ///< scene units, between the eyes
  float convergence_distance = 0;      ///< scene units, where the eyes' pictures coincide; 0: at infinity
  /// The shutter is open between these times of the scene, in [0, 1]; where they are the same, an instant.
  float shutter_open = 0, shutter_close = 0;
  /// What is added by time 1, at the end of the motion: to the position, the target, the up direction and
  /// (radians) the field of view of time 0. The two poses are interpolated as MovingTransform has it.
  vec3 motion_position{0}, motion_target{0}, motion_up{0};
  float motion_fov = 0;
  bool operator==(const Camera&) const = default;

  bool moves() const {
    return motion_position != vec3(0) || motion_target != vec3(0) || motion_up != vec3(0) || motion_fov != 0;
  }

  /// Whether rays go through a lens of elements.
  bool has_elements() const { return projection == Projection::perspective && lens != Lens::thin; }
  /// Width over height of what the film shows: `aspect`, of a stereo pair that of both views together; 0: as
  /// its pixels are.
  float film_aspect() const {
    return stereo == Stereo::side_by_side ? 2 * aspect
           : stereo == Stereo::top_bottom ? 0.5f * aspect
                                          : aspect;
  }
  float effective_focus_distance() const {
    return focus_distance > 0 ? focus_distance : glm::length(target - position);
  }
};

/// The camera as it is at time 1.
inline Camera camera_at_end(Camera camera) {
  camera.position += camera.motion_position;
  camera.target += camera.motion_target;
  camera.up += camera.motion_up;
  camera.vertical_fov = std::clamp(camera.vertical_fov + camera.motion_fov, radians(0.1f), radians(179.0f));
  return camera;
}

// Shapes, in the space of their instance. Those with a `radius` stand on or lie around the z axis.

struct SphereShape { ///< of the given radius about the origin
  float radius = 1;
  bool operator==(const SphereShape&) const = default;
};
struct RectangleShape { ///< [-1, 1]^2 in the xy plane, normal +z, as in Mitsuba
  bool operator==(const RectangleShape&) const = default;
};
struct DiscShape { ///< unit disc in the xy plane, normal +z
  bool operator==(const DiscShape&) const = default;
};
struct PlaneShape { ///< the unbounded xy plane, normal +z; uv = xy, so textures repeat
  bool operator==(const PlaneShape&) const = default;
};
struct CubeShape { ///< [-1, 1]^3, as in Mitsuba
  bool operator==(const CubeShape&) const = default;
};
struct CylinderShape { ///< from z = 0 to z = height
  float radius = 1, height = 1;
  bool caps = true; ///< closed by discs
  bool operator==(const CylinderShape&) const = default;
};
struct ConeShape { ///< from the base in z = 0 to the apex in z = height
  float radius = 1, height = 1;
  bool caps = true; ///< closed by the disc of its base
  bool operator==(const ConeShape&) const = default;
};
struct TorusShape { ///< a tube about the circle of `radius` in the xy plane; minor_radius below radius
  float radius = 1, minor_radius = 0.25f;
  bool operator==(const TorusShape&) const = default;
};
using Shape = std::variant<std::shared_ptr<const Mesh>, SphereShape, RectangleShape, DiscShape, PlaneShape,
                           CubeShape, CylinderShape, ConeShape, TorusShape, CurvesShape>;

/// A placed shape. Several instances may share one mesh.
struct Instance {
  std::string name;
  Shape shape;
  mat4 world_from_object{1.0f};
  std::vector<int> materials; ///< by the mesh's material slot; one entry for the other shapes
  Motion motion = {};         ///< from its place at time 0, world_from_object
  bool operator==(const Instance&) const = default;
};

/// A named view.
struct Bookmark {
  std::string name;
  Camera camera;
  bool operator==(const Bookmark&) const = default;
};

struct SceneDesc {
  std::string description; ///< free text for users
  Camera camera;
  std::vector<Bookmark> bookmarks;
  std::vector<Material> materials;
  std::vector<MediumDesc> media; ///< of different names
  std::string medium;            ///< that fills the scene where no body lies; empty: none
  std::vector<LightDesc> lights;
  std::vector<LightGroup> light_groups; ///< of different names
  std::vector<Instance> instances;
  std::vector<std::shared_ptr<const Texture>> textures;
  bool operator==(const SceneDesc&) const = default; ///< meshes, strands and pictures by identity
};

/// What is wrong with the name of a medium that is referred to: "cause; remedy"; empty if it is one of the
/// scene's, or none.
std::string medium_name_problem(const SceneDesc& scene, const std::string& name);

/// Bounds in the shape's own space; for planes those of the unit square.
Bounds3 shape_bounds(const Shape& shape);

/// World-space bounds of all shapes except planes (from the corners of their boxes, an upper bound); if there
/// are only planes, of their unit squares. Within kMaxCoordinate.
Bounds3 instance_bounds(const std::vector<Instance>& instances);

/// Names of the kinds of shapes in files, by the index of the variant: "mesh", "sphere" …
std::span<const std::string_view> shape_names();
std::string_view shape_name(const Shape& shape);
/// The default shape of a name, except "mesh"; nothing for unknown names.
std::optional<Shape> shape_of_name(std::string_view name);
/// Rows of the values of a shape's kind; their addresses are those in a Shape that holds this kind.
std::span<const Field<Shape>> shape_fields(const Shape& shape);
/// A problem that the rows cannot express: "minor_radius: …"; empty if the shape is valid.
std::string shape_problem(const Shape& shape);
/// The row with its limits narrowed such that the shape stays valid with its other values; for interactive
/// edits.
FieldInfo shape_limits(const Shape& shape, const Field<Shape>& row);

} // namespace candela
