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

/// The selection, or none if the scene has nothing of that index (any more).
Selection checked_selection(const SceneDesc& scene, const Selection& selection);

/// The name, or "Object 3", "Light 0"; empty for none.
std::string selection_name(const SceneDesc& scene, const Selection& selection);

/// Materials that emit, or emitted in `home`: one turned down to black can be turned up. The Lights panel
/// lists them after the lights.
std::vector<std::size_t> shining_materials(const SceneDesc& scene, const SceneDesc& home);

/// The selection's place in the Lights panel: the light, or the first emitting material of the object.
std::optional<int> light_row(const SceneDesc& scene, const SceneDesc& home, const Selection& selection);

/// Corners of the box about an object's shape, in world space: bit 0 of the index is x, bit 1 y, bit 2 z of
/// the object's own axes.
using BoxCorners = std::array<vec3, 8>;

/// Caches the box of the last mesh, so that one of a million vertices is scanned once.
class SelectionBox {
public:
  /// Nothing for what has no place: no selection, or an infinite light. A light is a point.
  std::optional<BoxCorners> corners(const SceneDesc& scene, const Selection& selection);
  /// What the selected object turns about and is scaled from, in its own space: the middle of its box; the
  /// origin of what has none.
  vec3 middle(const SceneDesc& scene, const Selection& selection);

private:
  Bounds3 box(const Instance& instance);

  std::shared_ptr<const Mesh> mesh_;
  Bounds3 mesh_bounds_;
};

Bounds3 bounds_of(const BoxCorners& corners);

} // namespace candela
