#include "scene/media_edits.h"

#include "materials/bsdf.h"
#include "materials/material_parts.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace candela {

namespace {

MediumDesc preset(const char* name, const MediumDescModel& model, const PhaseModel& phase, float scale = 1) {
  MediumDesc medium;
  medium.name = name;
  medium.model = model;
  medium.phase.model = phase;
  medium.scale = scale;
  return medium;
}

/// Of a pattern of ProceduralGrid, about the origin.
MediumDesc made_preset(const char* name, int pattern, vec3 size, const GridPlacement& placement,
                       const PhaseModel& phase) {
  ProceduralMediumModel model;
  static_cast<GridPlacement&>(model) = placement;
  model.pattern = pattern;
  model.size = size;
  return preset(name, model, phase);
}

MediumDesc fire_preset() {
  MediumDesc fire =
      made_preset("fire", 2, {1, 2, 1}, {.sigma_t = vec3(3), .albedo = vec3(0.1f), .temperature = 1900},
                  IsotropicPhase{});
  fire.emission = vec3(8);
  return fire;
}

MeasuredMediumModel measured(std::string_view name) {
  return {static_cast<int>(std::ranges::find(kMeasuredNames, name) - kMeasuredNames.begin())};
}

} // namespace

std::vector<MediumDesc> medium_presets() {
  constexpr vec3 kAll(1);
  return {
      preset("fog", HomogeneousMediumModel{kAll, kAll}, DropletsPhase{10}, 0.1f),
      preset("haze", HomogeneousMediumModel{{0.8f, 0.9f, 1}, {0.9f, 0.93f, 0.95f}},
             HenyeyGreensteinPhase{0.6f}, 0.02f),
      preset("air", HomogeneousMediumModel{{0.18f, 0.41f, 1}, kAll}, RayleighPhase{}, 0.01f),
      preset("smoke", HomogeneousMediumModel{kAll, vec3(0.4f)}, HenyeyGreensteinPhase{0.3f}),
      preset("murky water", HomogeneousMediumModel{{0.9f, 0.5f, 0.45f}, {0.3f, 0.75f, 0.7f}},
             HenyeyGreensteinPhase{0.8f}),
      preset("milk", measured("whole_milk"), HenyeyGreensteinPhase{0.7f}),
      preset("skin", measured("skin1"), IsotropicPhase{}),
      preset("marble", measured("marble"), IsotropicPhase{}),
      made_preset("cloud", 0, {2, 1.2f, 1.6f}, {.sigma_t = vec3(40), .albedo = vec3(0.999f)},
                  DropletsPhase{10}),
      made_preset("ball of smoke", 1, vec3(2), {.sigma_t = vec3(12), .albedo = vec3(0.8f)},
                  HenyeyGreensteinPhase{0.3f}),
      fire_preset(),
      preset("wax", HomogeneousMediumModel{{1.5f, 1.6f, 1.7f}, {0.998f, 0.98f, 0.88f}},
             HenyeyGreensteinPhase{0.5f}),
  };
}

std::size_t add_grid_medium(SceneDesc& scene, std::shared_ptr<const VolumeGrid> grid, const Bounds3& within) {
  const vec3 side = grid->bounds.diagonal();
  const vec3 room = within.empty() ? vec3(2) : glm::max(within.diagonal(), vec3(1e-3f));
  const float scale = min_component(room / side);
  MediumDesc medium;
  medium.name = std::filesystem::path(grid->source).stem().string();
  if (medium.name.empty()) medium.name = "grid";
  GridMediumModel model;
  model.center = within.empty() ? vec3(0) : within.center();
  model.size = glm::max(scale * side, vec3(1e-6f));
  model.sigma_t = vec3(10 / max_component(model.size)); // thick where the density is 1
  model.grid = std::move(grid);
  medium.model = std::move(model);
  const std::size_t index = add_medium(scene, std::move(medium));
  scene.medium = scene.media[index].name;
  return index;
}

void take_box_of_file(MediumDesc& medium) {
  auto* model = std::get_if<GridMediumModel>(&medium.model);
  if (model == nullptr || !model->grid) return;
  model->center = model->grid->bounds.center();
  model->size = glm::max(model->grid->bounds.diagonal(), vec3(1e-6f));
}

std::size_t add_medium(SceneDesc& scene, MediumDesc medium) {
  const std::string stem = medium.name;
  auto taken = [&](const std::string& name) {
    return std::ranges::find(scene.media, name, &MediumDesc::name) != scene.media.end();
  };
  for (int i = 2; taken(medium.name); ++i) medium.name = fmt::format("{} {}", stem, i);
  scene.media.push_back(std::move(medium));
  return scene.media.size() - 1;
}

namespace {

void replace_medium_name(SceneDesc& scene, const std::string& before, const std::string& after) {
  if (scene.medium == before) scene.medium = after;
  for (Material& material : scene.materials)
    if (material.medium == before) material.medium = after;
}

} // namespace

void remove_medium(SceneDesc& scene, std::size_t index) {
  replace_medium_name(scene, scene.media[index].name, "");
  scene.media.erase(scene.media.begin() + static_cast<std::ptrdiff_t>(index));
}

bool rename_medium(SceneDesc& scene, std::size_t index, const std::string& name) {
  const auto known = std::ranges::find(scene.media, name, &MediumDesc::name);
  if (name.empty() || known != scene.media.end()) return false;
  replace_medium_name(scene, scene.media[index].name, name);
  scene.media[index].name = name;
  return true;
}

bool lets_light_in(const SceneDesc& scene, const Material& material) {
  if (is_null(material) || material.opacity.is_textured() || material.opacity.value < 1) return true;
  bool any = false, combined = false;
  each_part(material, [&](const MaterialField&, int index) {
    combined = true;
    if (index >= 0) any |= lets_light_in(scene, scene.materials[static_cast<std::size_t>(index)]);
  });
  if (combined) return any;
  return with_closure(
      material.model, [](const auto& parameter) { return parameter.value; },
      [](const auto& closure) { return has_any(closure.flags(), BsdfFlags::transmission); });
}

bool fill_instance(SceneDesc& scene, std::size_t instance, const std::string& medium) {
  auto used_by_others = [&](int material) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
      if (i != instance &&
          std::ranges::find(scene.instances[i].materials, material) != scene.instances[i].materials.end())
        return true;
    return false;
  };
  std::map<int, int> copies;
  bool any = false;
  for (int& material : scene.instances[instance].materials) {
    if (used_by_others(material)) {
      const auto [copy, is_new] = copies.try_emplace(material, static_cast<int>(scene.materials.size()));
      if (is_new) {
        Material copied = scene.materials[static_cast<std::size_t>(material)];
        if (!copied.name.empty()) copied.name += " (filled)";
        scene.materials.push_back(std::move(copied));
      }
      material = copy->second;
    }
    Material& own = scene.materials[static_cast<std::size_t>(material)];
    own.medium = medium;
    any |= lets_light_in(scene, own);
  }
  return any;
}

} // namespace candela
