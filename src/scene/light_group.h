#pragma once
// Lights that are switched and scaled together.

#include "core/fields.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

struct LightDesc;
struct Material;
struct SceneDesc;

/// The lights and emitting materials whose `group` is its name.
struct LightGroup {
  std::string name;
  bool on = true;
  float scale = 1; ///< multiplies what they send
  bool operator==(const LightGroup&) const = default;

  float factor() const { return on ? scale : 0; }
};

/// The rows of a group's values but its name.
std::span<const Field<LightGroup>> light_group_fields();

/// Names of all groups: those of scene.light_groups, then those that lights and materials name besides, which
/// are on.
std::vector<std::string> light_group_names(const SceneDesc& scene);
/// The group of that name, which is added where there is none.
LightGroup& light_group(SceneDesc& scene, std::string_view name);

/// Whether any group is off or scaled; without one, the next two are the scene's own.
bool has_scaled_groups(const SceneDesc& scene);
/// The scene's lights and materials with the factors of their groups in their colours.
std::vector<LightDesc> grouped_lights(const SceneDesc& scene);
std::vector<Material> grouped_materials(const SceneDesc& scene);

/// What is wrong with the groups: "light_groups[0].name: cause; remedy"; empty if all is well.
std::string light_groups_problem(const SceneDesc& scene);

} // namespace candela
