#include "scene/light_group.h"

#include "scene/scene_desc.h"

#include <fmt/format.h>

#include <set>

namespace candela {

std::span<const Field<LightGroup>> light_group_fields() {
  static const std::vector<Field<LightGroup>> fields{
      {{"on", FieldType::boolean, 0, 0, "", "Whether the lights of the group shine", Invalidates::scene},
       [](LightGroup& group) -> void* { return &group.on; }},
      {{"scale", FieldType::real, 0, 1e9, "", "Multiplies what they send", Invalidates::scene, {}, true},
       [](LightGroup& group) -> void* { return &group.scale; }}};
  return fields;
}

std::vector<std::string> light_group_names(const SceneDesc& scene) {
  std::vector<std::string> names;
  auto add = [&](const std::string& name) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const LightGroup& group : scene.light_groups) add(group.name);
  for (const LightDesc& light : scene.lights) add(light.group);
  for (const Material& material : scene.materials) add(material.group);
  return names;
}

LightGroup& light_group(SceneDesc& scene, std::string_view name) {
  auto known = std::ranges::find(scene.light_groups, name, &LightGroup::name);
  if (known != scene.light_groups.end()) return *known;
  LightGroup group;
  group.name = name;
  return scene.light_groups.emplace_back(std::move(group));
}

bool has_scaled_groups(const SceneDesc& scene) {
  return std::ranges::any_of(scene.light_groups, [](const LightGroup& g) { return g.factor() != 1; });
}

namespace {

/// Calls scale(member, factor) for those of a group whose factor is not 1.
template <class Member, class Scale>
std::vector<Member> grouped(std::vector<Member> members, const std::vector<LightGroup>& groups, Scale scale) {
  for (const LightGroup& group : groups) {
    if (group.factor() == 1) continue;
    for (Member& member : members)
      if (member.group == group.name) scale(member, group.factor());
  }
  return members;
}

} // namespace

std::vector<LightDesc> grouped_lights(const SceneDesc& scene) {
  return grouped(scene.lights, scene.light_groups,
                 [](LightDesc& light, float factor) { light.scale *= factor; });
}

std::vector<Material> grouped_materials(const SceneDesc& scene) {
  return grouped(scene.materials, scene.light_groups, [](Material& material, float factor) {
    material.emission.value *= factor, material.emission.offset *= factor;
  });
}

std::string light_groups_problem(const SceneDesc& scene) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.light_groups.size(); ++i) {
    const LightGroup& group = scene.light_groups[i];
    const auto at = [&](std::string_view key) { return fmt::format("light_groups[{}].{}", i, key); };
    if (group.name.empty()) return at("name") + ": is empty; give the name that lights have as \"group\"";
    if (!names.insert(group.name).second)
      return fmt::format("{}: '{}' is there twice; keep one", at("name"), group.name);
    for (const auto& row : light_group_fields())
      if (auto problem = field_problem(row, row.address(const_cast<LightGroup&>(group))); !problem.empty())
        return fmt::format("{}: {}; give {}", at(row.key), problem, field_domain(row));
  }
  return {};
}

} // namespace candela
