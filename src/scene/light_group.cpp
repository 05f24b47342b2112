#include "scene/light_group.h"

#include "scene/scene_desc.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace candela {

std::span<const Field<LightGroup>> light_group_fields() {
  constexpr auto kDisplay = Invalidates::display; // where the film keeps the groups apart (light_layers.h)
  static const std::vector<Field<LightGroup>> fields{
      {{"on", FieldType::boolean, 0, 0, "", "Whether the lights of the group shine", kDisplay},
       [](LightGroup& group) -> void* { return &group.on; }},
      {{"scale", FieldType::real, 0, 1e9, "", "Multiplies what they send", kDisplay, {}, true},
       [](LightGroup& group) -> void* { return &group.scale; }},
      {{"color", FieldType::color, 0, 1e9, "", "Multiplies what they send, channel by channel", kDisplay},
       [](LightGroup& group) -> void* { return &group.color; }},
      {{"solo", FieldType::boolean, 0, 0, "",
        "While any group is solo, only such groups shine, and no lights without a group", kDisplay},
       [](LightGroup& group) -> void* { return &group.solo; }}};
  return fields;
}

namespace {

void add_name(std::vector<std::string>& names, const std::string& name) {
  if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

bool has_solo(const SceneDesc& scene) { return std::ranges::any_of(scene.light_groups, &LightGroup::solo); }

} // namespace

std::vector<std::string> used_group_names(const SceneDesc& scene) {
  std::vector<std::string> names;
  for (const LightDesc& light : scene.lights) add_name(names, light.group);
  for (const Material& material : scene.materials) add_name(names, material.group);
  return names;
}

std::vector<std::string> light_group_names(const SceneDesc& scene) {
  std::vector<std::string> names = used_group_names(scene);
  for (const LightGroup& group : scene.light_groups) add_name(names, group.name);
  return names;
}

LightGroup& light_group(SceneDesc& scene, std::string_view name) {
  auto known = std::ranges::find(scene.light_groups, name, &LightGroup::name);
  if (known != scene.light_groups.end()) return *known;
  LightGroup group;
  group.name = name;
  return scene.light_groups.emplace_back(std::move(group));
}

vec3 light_factor(const SceneDesc& scene, std::string_view name) {
  const auto known = std::ranges::find(scene.light_groups, name, &LightGroup::name);
  const bool listed = !name.empty() && known != scene.light_groups.end();
  if (has_solo(scene) && !(listed && known->solo)) return vec3(0);
  return listed ? known->factor() : vec3(1);
}

bool has_scaled_groups(const SceneDesc& scene) {
  return std::ranges::any_of(scene.light_groups,
                             [](const LightGroup& g) { return g.solo || g.factor() != vec3(1); });
}

namespace {

/// Calls scale(member, factor) for those of a group whose factor is not 1.
template <class Member, class Scale>
std::vector<Member> grouped(std::vector<Member> members, const SceneDesc& scene, Scale scale) {
  if (!has_scaled_groups(scene)) return members;
  std::map<std::string, vec3> factors{{"", light_factor(scene, "")}};
  for (const std::string& name : light_group_names(scene)) factors[name] = light_factor(scene, name);
  for (Member& member : members)
    if (const vec3 factor = factors.at(member.group); factor != vec3(1)) scale(member, factor);
  return members;
}

} // namespace

std::vector<LightDesc> grouped_lights(const SceneDesc& scene) {
  return grouped(scene.lights, scene, [](LightDesc& light, vec3 factor) {
    if (factor == vec3(factor.x))
      light.scale *= factor.x;
    else
      light.color *= factor;
  });
}

std::vector<Material> grouped_materials(const SceneDesc& scene) {
  return grouped(scene.materials, scene, [](Material& material, vec3 factor) {
    material.emission.value *= factor, material.emission.offset *= factor;
  });
}

std::vector<MediumDesc> grouped_media(const SceneDesc& scene) {
  std::vector<MediumDesc> media = scene.media;
  const vec3 factor = light_factor(scene, "");
  for (MediumDesc& medium : media) medium.emission *= factor;
  return media;
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
