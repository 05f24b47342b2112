#pragma once
// The object or light that the user has selected.

#include "core/bounds.h"
#include "scene/scene_desc.h"

#include <array>
#include <optional>
#include <string>

namespace candela {

struct Selection {
  enum class Kind { none, object, light };
  Kind kind = Kind::none;
  int index = -1; ///< into SceneDesc::instances or ::lights
  bool operator==(const Selection&) const = default;
};

/// The selection, or none if the scene has no such object or light (any more).
Selection checked_selection(const SceneDesc& scene, const Selection& selection);

/// The name, or "Object 3", "Light 0"; empty for none.
std::string selection_name(const SceneDesc& scene, const Selection& selection);

/// Materials that emit, or did in `home`, so that one set to black can be edited again. The Lights panel
/// lists them after the lights.
std::vector<std::size_t> shining_materials(const SceneDesc& scene, const SceneDesc& home);

/// The selection's index in the Lights panel: the light, or the first emitting material of the object.
std::optional<int> light_row(const SceneDesc& scene, const SceneDesc& home, const Selection& selection);

/// World-space corners of the bounding box of an object's shape; bits 0, 1, 2 of the index are x, y, z of the
/// object's axes.
using BoxCorners = std::array<vec3, 8>;

/// Caches the last mesh's bounds, since a mesh may have millions of vertices.
class SelectionBox {
public:
  /// World-space corners of the selection's box; nothing without a selection or for an infinite light. A
  /// light's box is a point.
  std::optional<BoxCorners> corners(const SceneDesc& scene, const Selection& selection);
  /// The centre of rotation and scaling in object space: the centre of the bounding box, or the origin
  /// without one.
  vec3 middle(const SceneDesc& scene, const Selection& selection);

private:
  Bounds3 box(const Instance& instance);

  std::shared_ptr<const Mesh> mesh_;
  Bounds3 mesh_bounds_;
};

Bounds3 bounds_of(const BoxCorners& corners);

} // namespace candela
