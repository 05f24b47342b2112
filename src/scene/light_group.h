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
struct MediumDesc;
struct SceneDesc;

/// The lights and emitting materials whose `group` is its name.
struct LightGroup {
  std::string name;
  bool on = true;
  float scale = 1;   ///< multiplies what they send
  vec3 color{1};     ///< likewise, channel by channel
  bool solo = false; ///< while any group is, only such groups shine
  bool operator==(const LightGroup&) const = default;

  vec3 factor() const { return on ? scale * color : vec3(0); }
};

/// The rows of a group's values but its name.
std::span<const Field<LightGroup>> light_group_fields();

/// Names of the groups that lights and materials belong to, in the order of the lights, then the materials:
/// one that does not depend on scene.light_groups, so that it stays when these are edited.
std::vector<std::string> used_group_names(const SceneDesc& scene);
/// Names of all groups: the used ones, then the others of scene.light_groups. Groups that are not in that
/// list are on.
std::vector<std::string> light_group_names(const SceneDesc& scene);
/// The group of that name, which is added where there is none.
LightGroup& light_group(SceneDesc& scene, std::string_view name);

/// What lights of the group of that name are multiplied by, other groups' solo included; empty: of those
/// without a group.
vec3 light_factor(const SceneDesc& scene, std::string_view name);
/// Whether any group is off, scaled, coloured or solo; without one, the next two are the scene's own.
bool has_scaled_groups(const SceneDesc& scene);
/// The scene's lights and materials with the factors of their groups in their colours.
std::vector<LightDesc> grouped_lights(const SceneDesc& scene);
std::vector<Material> grouped_materials(const SceneDesc& scene);
/// The same of media that shine, which have no group.
std::vector<MediumDesc> grouped_media(const SceneDesc& scene);

/// What is wrong with the groups: "light_groups[0].name: cause; remedy"; empty if all is well.
std::string light_groups_problem(const SceneDesc& scene);

} // namespace candela
