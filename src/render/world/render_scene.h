#pragma once
// A Document made ready to render; const while it is.

#include "render/world/sealed_media.h"

namespace candela {

class RenderScene {
public:
  /// Shares the parts of `previous` that the document does not change: geometry where the instances are the
  /// same, materials and lights (scene_parts.h), and environment maps.
  /// Throws Cancelled soon after `progress` is told to end; it may be null.
  static std::shared_ptr<const RenderScene>
  build(const Document& document, const RenderScene* previous = nullptr, Progress* progress = nullptr);
  /// The same with geometry that was made of the document's instances.
  static std::shared_ptr<const RenderScene> build(const Document& document,
                                                  std::shared_ptr<const Geometry> geometry,
                                                  const RenderScene* previous, Progress* progress = nullptr);

  const std::vector<Instance>& instances() const { return *instances_; }
  const std::shared_ptr<const Geometry>& shared_geometry() const { return geometry_; }
  const std::shared_ptr<const SceneMaterials>& shared_materials() const { return materials_; }
  const std::shared_ptr<const SceneLights>& shared_lights() const { return lights_; }
  const Geometry& geometry() const { return *geometry_; }
  const SurfaceMaterial& material(std::uint32_t index) const { return surfaces_[index]; }
  /// Whether any surface lets light straight through, so that rays must look.
  bool has_transparency() const { return has_transparency_; }
  /// Whether any surface is not there at all (null materials).
  bool has_invisible() const { return has_invisible_; }
  /// Whether any body has a priority: surfaces inside of higher ones are not there, and what a surface does
  /// depends on what lies outside of it.
  bool has_priorities() const { return has_priorities_; }
  /// Whether rays may go on behind a surface that they meet.
  bool has_passable_surfaces() const { return has_transparency_ || has_priorities_; }
  /// Whether any body is filled with something, so that rays must know where they are.
  bool has_media() const { return has_media_; }
  /// Whether light may leave any surface away from where it enters it (SurfaceMaterial::diffuses).
  bool has_subsurface() const { return has_subsurface_; }
  /// Whether any texture is looked up over the footprint of a ray, so that rays must carry cones.
  bool filters_textures() const { return filters_textures_; }
  /// Whether any medium scatters or sends out light, so that more happens between surfaces than absorption.
  bool has_active_media() const { return has_active_media_; }
  /// What fills a place that lies in those bodies.
  MediumId filling(const MediumStack& bodies) const {
    const MediumId inside = bodies.current();
    return inside ? inside : materials_->world_medium();
  }
  /// As sealed_media() has it; of scenes with active media.
  bool is_sealed(MediumId id) const { return sealed_[id.index]; }
  const Medium& medium(MediumId id) const { return materials_->media()[id.index]; }
  /// Index of refraction over vacuum; 1 of no medium.
  float ior(MediumId id) const { return id ? materials_->media_iors()[id.index] : 1; }

  const std::vector<Light>& lights() const { return lights_->lights(); }
  /// The light that a primitive is (part of), or kNoLight.
  std::uint32_t light_of(std::uint64_t emitter) const { return lights_->light_of(emitter); }
  /// Whether any of the lights, by index, has a radiance that a texture gives.
  bool has_textured_lights() const { return lights_->has_textured_lights(); }
  /// Of that light; null where its radiance is the same everywhere.
  const EmitterTexture* emitter_texture(std::uint32_t light) const { return lights_->emitter_texture(light); }
  /// Layers of a film that keeps light groups apart; 0: there are none.
  std::size_t layer_count() const { return layer_count_; }
  const LightLayers& light_layers() const { return lights_->layers(); }
  /// The layer of a light, and of a material's emission; only where there are layers.
  std::uint8_t layer_of_light(std::uint32_t light) const { return lights_->layer_of(light); }
  std::uint8_t layer_of_material(std::uint32_t material) const {
    return lights_->layers().of_material[material];
  }
  /// The layer of what media send out, which belong to no group.
  std::uint8_t layer_of_media() const { return static_cast<std::uint8_t>(lights_->layers().names.size()); }
  const std::vector<std::uint32_t>& infinite_lights() const { return lights_->infinite_lights(); }

  /// Choice of a light as path.light_choice has it: among all, or among those that light sampling alone can
  /// find.
  const LightSelection& all_lights() const { return lights_->all_lights(); }
  const LightSelection& delta_lights() const { return lights_->delta_lights(); }

  std::size_t memory_bytes() const;

private:
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const std::vector<Instance>> instances_; ///< what geometry_ was built from
  std::shared_ptr<const SceneMaterials> materials_;
  std::shared_ptr<const SceneLights> lights_;
  std::vector<bool> sealed_; ///< by the index of the medium
  MeshHulls hulls_;
  // Of *materials_, where every ray reads them.
  const SurfaceMaterial* surfaces_ = nullptr;
  bool has_transparency_ = false, has_invisible_ = false, has_priorities_ = false, has_media_ = false,
       has_active_media_ = false, filters_textures_ = false, has_subsurface_ = false;
  std::size_t layer_count_ = 0;
};

} // namespace candela
