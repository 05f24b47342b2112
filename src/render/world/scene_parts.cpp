// What makes a part of a scene serve the next one.

#include "render/world/scene_parts.h"

#include <set>

namespace candela {

namespace {

bool is_same(const TexturedParameter* a, const TexturedParameter* b) {
  if (a == nullptr || b == nullptr) return a == b;
  return a->texture == b->texture && a->use == b->use && a->factor == b->factor && a->offset == b->offset &&
         a->lowest == b->lowest && a->highest == b->highest;
}

/// Whether the factors of groups are part of the scene, rather than of the mix of the film's layers.
bool has_factors(const SceneDesc& scene, const LightLayers& layers) {
  return layers.empty() && has_scaled_groups(scene);
}
bool has_factors(const Document& document) {
  return has_scaled_groups(document.scene) && light_layers(document).empty();
}

/// Whether `known` is what `grouped` makes of the scene, if `scaled`. Groups that change nothing need no
/// copies.
template <class Members, class Grouped>
bool is_grouped(const Members& known, const SceneDesc& scene, bool scaled, const Members& own,
                Grouped grouped) {
  return scaled ? known == grouped(scene) : known == own;
}

} // namespace

bool emits_alike(const SurfaceMaterial& a, const SurfaceMaterial& b) {
  if (!a.emissive && !b.emissive) return true;
  return a.emissive == b.emissive && a.emission == b.emission && a.opacity == b.opacity &&
         a.two_sided_emission == b.two_sided_emission && is_same(a.emission_texture, b.emission_texture) &&
         is_same(a.opacity_texture, b.opacity_texture);
}

SceneMaterials::SceneMaterials(const Document& document, const SceneMaterials* previous,
                               const Progress* progress)
    : source_(has_factors(document) ? grouped_materials(document.scene) : document.scene.materials),
      textures_(document.scene.textures), override_(document.settings.override_brdf),
      source_media_(has_factors(document) ? grouped_media(document.scene) : document.scene.media),
      source_world_(document.scene.medium), source_estimator_(document.settings.path.transmittance),
      grids_(previous != nullptr ? &previous->grids_ : nullptr, progress) {
  add_materials(document, [&](const ImageTexture& image, ColorSpace space) {
    auto fits = [&](const auto& pyramid) {
      return pyramid->texels() == image.texels && pyramid->color_space() == space;
    };
    const auto own = std::ranges::find_if(pyramids_, fits);
    if (own != pyramids_.end()) return own->get();
    std::shared_ptr<const MipPyramid> pyramid;
    if (previous != nullptr) {
      const auto known = std::ranges::find_if(previous->pyramids_, fits);
      if (known != previous->pyramids_.end()) pyramid = *known;
    }
    if (!pyramid) pyramid = std::make_shared<const MipPyramid>(image.texels, space, progress);
    pyramids_.push_back(pyramid);
    return pyramid.get();
  });
}

std::shared_ptr<const SceneMaterials> SceneMaterials::of(const Document& document,
                                                         std::shared_ptr<const SceneMaterials> previous,
                                                         const Progress* progress) {
  if (previous != nullptr &&
      is_grouped(previous->source_, document.scene, has_factors(document), document.scene.materials,
                 grouped_materials) &&
      previous->textures_ == document.scene.textures &&
      previous->override_ == document.settings.override_brdf &&
      is_grouped(previous->source_media_, document.scene, has_factors(document), document.scene.media,
                 grouped_media) &&
      previous->source_world_ == document.scene.medium &&
      previous->source_estimator_ == document.settings.path.transmittance)
    return previous;
  return std::make_shared<const SceneMaterials>(document, previous.get(), progress);
}

std::size_t SceneMaterials::memory_bytes() const {
  std::size_t bytes = materials_.memory_bytes();
  for (const auto& pyramid : pyramids_) bytes += pyramid->memory_bytes();
  bytes += grids_.memory_bytes();
  std::set<const void*> counted; // several textures may share their texels
  for (const auto& texture : textures_) {
    const ImageTexture* image = texture->image();
    const void* data = image != nullptr ? static_cast<const void*>(image->texels.get()) : texture.get();
    if (!counted.insert(data).second) continue;
    bytes += std::visit([](const auto& kind) { return kind.memory_bytes(); }, texture->model);
  }
  return bytes;
}

SceneLights::SceneLights(const Document& document, std::shared_ptr<const Geometry> geometry,
                         std::shared_ptr<const SceneMaterials> materials, const SceneLights* previous,
                         const Progress* progress)
    : geometry_(std::move(geometry)), kept_materials_(std::move(materials)), materials_(*kept_materials_),
      layers_(light_layers(document)),
      source_(has_factors(document.scene, layers_) ? grouped_lights(document.scene) : document.scene.lights),
      light_choice_(document.settings.path.light_choice) {
  add_emitters(previous, progress);
  add_lights(previous, progress);
  add_selections(progress);
}

std::shared_ptr<const SceneLights> SceneLights::of(const Document& document,
                                                   const std::shared_ptr<const Geometry>& geometry,
                                                   const std::shared_ptr<const SceneMaterials>& materials,
                                                   std::shared_ptr<const SceneLights> previous,
                                                   const Progress* progress) {
  if (previous != nullptr && previous->geometry_ == geometry && previous->layers_ == light_layers(document) &&
      is_grouped(previous->source_, document.scene, has_factors(document.scene, previous->layers_),
                 document.scene.lights, grouped_lights) &&
      previous->light_choice_ == document.settings.path.light_choice &&
      std::ranges::equal(previous->materials_, *materials, emits_alike))
    return previous;
  return std::make_shared<const SceneLights>(document, geometry, materials, previous.get(), progress);
}

void SceneLights::add_selections(const Progress* progress) {
  const Bounds3 bounds = geometry_->finite_bounds();
  const float radius = bounds.empty() ? 1.0f : std::max(0.5f * glm::length(bounds.diagonal()), 1e-6f);
  std::vector<std::uint32_t> all, delta;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    all.push_back(i);
    if (is_delta_light(lights_[i])) delta.push_back(i);
  }
  all_lights_ = LightSelection(lights_, all, light_choice_, radius, progress);
  delta_lights_ = LightSelection(lights_, delta, light_choice_, radius, progress);
}

std::size_t SceneLights::memory_bytes() const {
  std::size_t bytes = lights_.size() * sizeof(Light) + layer_of_light_.size() +
                      light_of_emitter_.memory_bytes() + all_lights_.memory_bytes() +
                      delta_lights_.memory_bytes();
  for (const ShownEmission& shown : emission_tables_)
    if (shown.table->grid) bytes += shown.table->grid->memory_bytes();
  for (const auto& map : environment_maps_) bytes += map->memory_bytes();
  for (const KnownSky& known : skies_) bytes += known.sky->sky->image.pixels.size() * sizeof(vec3);
  return bytes + portals_.memory_bytes();
}

} // namespace candela
