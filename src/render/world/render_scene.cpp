#include "render/world/render_scene.h"

#include "core/error.h"
#include "materials/material_parts.h"

#include <set>

namespace candela {

std::shared_ptr<const RenderScene> RenderScene::build(const Document& document, const RenderScene* previous,
                                                      Progress* progress) {
  const std::vector<Instance>& instances = document.scene.instances;
  const bool same = previous != nullptr && previous->instances() == instances;
  return build(document,
               same ? previous->geometry_ : Geometry::build(instances, BuildQuality::high, progress),
               previous, progress);
}

std::shared_ptr<const RenderScene> RenderScene::build(const Document& document,
                                                      std::shared_ptr<const Geometry> geometry,
                                                      const RenderScene* previous, Progress* progress) {
  auto scene = std::make_shared<RenderScene>();
  const bool same_geometry = previous != nullptr && previous->geometry_ == geometry;
  scene->geometry_ = std::move(geometry);
  scene->instances_ = same_geometry ? previous->instances_
                                    : std::make_shared<const std::vector<Instance>>(document.scene.instances);
  scene->materials_ =
      SceneMaterials::of(document, previous != nullptr ? previous->materials_ : nullptr, progress);
  scene->surfaces_ = scene->materials_->data();
  scene->has_transparency_ = scene->materials_->has_transparency();
  scene->has_invisible_ = scene->materials_->has_invisible();
  scene->has_priorities_ = scene->materials_->has_priorities();
  scene->filters_textures_ = scene->materials_->filters_textures();
  scene->has_subsurface_ = scene->materials_->has_subsurface();
  scene->has_media_ = !scene->materials_->media().empty();
  scene->has_active_media_ = scene->materials_->has_scattering() || scene->materials_->has_medium_emission();
  scene->lights_ = SceneLights::of(document, scene->geometry_, scene->materials_,
                                   previous != nullptr ? previous->lights_ : nullptr, progress);
  if (scene->has_active_media_) {
    if (previous != nullptr) scene->hulls_ = previous->hulls_;
    scene->sealed_ = sealed_media(scene->instances(), *scene->materials_, scene->lights(), scene->hulls_);
  }
  scene->layer_count_ = scene->lights_->layers().count();
  return scene;
}

void SceneMaterials::add_materials(const Document& document, const MipPyramidSource& pyramids) {
  const OverrideSettings& o = document.settings.override_brdf;
  const Material overriding = o.is_on() ? overriding_material(o) : Material();
  std::vector<const Material*> scattering; // what each surface scatters by
  for (const Material& own : source_) {
    const bool overridden = o.is_on() && !is_null(own);
    if (overridden) {
      Material m = own;
      m.model = overriding.model;
      materials_.add(m, textures_, pyramids);
    } else {
      materials_.add(own, textures_, pyramids, source_);
    }
    scattering.push_back(overridden ? &overriding : &own);
    has_invisible_ |= is_null(own);
    has_transparency_ |= is_null(own) || own.opacity.value < 1 || own.opacity.is_textured();
  }
  for (const SurfaceMaterial& m : materials_)
    has_subsurface_ |= m.diffuses || (m.back != nullptr && m.back->diffuses);
  add_media(scattering);
}

/// `layers[index]` is that of the light.
void SceneLights::add_light(const Light& light, const std::vector<std::uint8_t>& layers, std::size_t index) {
  lights_.push_back(light);
  if (!layers_.empty()) layer_of_light_.push_back(layers[index]);
}

void SceneLights::add_emitter(std::uint64_t emitter, std::uint32_t material, Light light) {
  const auto index = static_cast<std::uint32_t>(lights_.size());
  light_of_emitter_.set(emitter, index);
  add_light(light, layers_.of_material, material);
  if (!has_textured_radiance(materials_[material])) return;
  emitter_textures_.resize(index + 1);
  emitter_textures_[index] = {emitter, &materials_[material]};
}

void SceneLights::add_emitters(const SceneLights* previous, const Progress* progress) {
  bool any = false;
  for (const SurfaceMaterial& m : materials_) any |= m.emissive;
  if (!any) return;
  light_of_emitter_.reset(geometry_->emitter_count());
  auto table = [&](const SurfaceMaterial& m, EmissionChart chart) -> const EmissionTable& {
    return emission_table(m, chart, previous, progress);
  };
  geometry_->surfaces().for_each([&](const auto& kind, std::uint64_t first) {
    auto emits = [&](std::uint32_t material) { return materials_[material].emissive; };
    auto add = [&](std::uint64_t number, std::uint32_t count, std::uint32_t material, auto make) {
      const SurfaceMaterial& m = materials_[material];
      const std::uint64_t emitter = first + number;
      const auto made = make(EmitterRadiance(m, table));
      if constexpr (requires { made.has_value(); }) { // a light, or nothing that can be sampled
        if (made) add_emitter(emitter, material, *made);
        return;
      } else {
        add_emitter(emitter, material, made);
      }
      for (std::uint32_t i = 1; i < count; ++i)
        light_of_emitter_.set(emitter + i, light_of_emitter_[emitter]);
    };
    kind.for_each_light(emits, add, progress);
  });
}

const EmissionTable& SceneLights::emission_table(const SurfaceMaterial& material, EmissionChart chart,
                                                 const SceneLights* previous, const Progress* progress) {
  auto fits = [&](const ShownEmission& known) {
    return known.chart == chart && emits_alike(*known.material, material);
  };
  auto own = std::ranges::find_if(emission_tables_, fits);
  if (own != emission_tables_.end()) return *own->table;
  std::shared_ptr<const EmissionTable> table;
  if (previous != nullptr) {
    auto known = std::ranges::find_if(previous->emission_tables_, fits);
    if (known != previous->emission_tables_.end()) table = known->table;
  }
  if (!table) table = std::make_shared<const EmissionTable>(tabulate_emission(material, chart, progress));
  emission_tables_.push_back({&material, chart, table});
  return *table;
}

const EnvironmentMap* SceneLights::environment_map(const EnvironmentLightModel& light,
                                                   const SceneLights* previous, const Progress* progress) {
  auto fits = [&](const auto& map) {
    return map->panorama() == light.panorama && map->mapping() == light.mapping;
  };
  auto own = std::ranges::find_if(environment_maps_, fits);
  if (own != environment_maps_.end()) return own->get();
  std::shared_ptr<const EnvironmentMap> map;
  if (previous != nullptr) {
    auto known = std::ranges::find_if(previous->environment_maps_, fits);
    if (known != previous->environment_maps_.end()) map = *known;
  }
  if (!map) map = std::make_shared<const EnvironmentMap>(light.panorama, light.mapping, progress);
  environment_maps_.push_back(map);
  return map.get();
}

const SkyModel* SceneLights::sky(const SkyParameters& parameters, const SceneLights* previous,
                                 const Progress* progress) {
  auto fits = [&](const KnownSky& known) { return known.parameters == parameters; };
  auto own = std::ranges::find_if(skies_, fits);
  if (own != skies_.end()) return own->sky.get();
  std::shared_ptr<const SkyModel> made;
  if (previous != nullptr) {
    auto known = std::ranges::find_if(previous->skies_, fits);
    if (known != previous->skies_.end()) made = known->sky;
  }
  if (!made) made = std::make_shared<const SkyModel>(make_sky(parameters, progress));
  return skies_.emplace_back(KnownSky{parameters, made}).sky.get();
}

void SceneLights::add_lights(const SceneLights* previous, const Progress* progress) {
  const LightResources resources{
      [&](const EnvironmentLightModel& m) { return environment_map(m, previous, progress); },
      [&](const SkyParameters& parameters) { return sky(parameters, previous, progress); }};
  portals_ = ScenePortals(source_);
  for (std::size_t i = 0; i < source_.size(); ++i) {
    if (is_black(source_[i].color * source_[i].scale)) continue;
    for (Light light : make_lights(source_[i], resources)) {
      portals_.give(light, previous != nullptr ? &previous->portals_ : nullptr, progress);
      if (light_kind(light) == LightKind::infinite)
        infinite_lights_.push_back(static_cast<std::uint32_t>(lights_.size()));
      add_light(light, layers_.of_light, i);
    }
  }
}

std::size_t RenderScene::memory_bytes() const {
  return geometry_->memory_bytes() + materials_->memory_bytes() + lights_->memory_bytes();
}

} // namespace candela
