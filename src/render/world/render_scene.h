#pragma once
// A Document made ready to render; const while it is.

#include "render/lights/emitter_lights.h"
#include "render/lights/light_selection.h"
#include "render/world/emitter_texture.h"
#include "render/world/geometry.h"
#include "render/world/surface_material.h"
#include "scene/document.h"

namespace candela {

class RenderScene {
public:
  /// Reuses the geometry of `previous` where the instances are the same, and what it made of panoramas.
  /// Throws Cancelled soon after `progress` is told to end; it may be null.
  static std::shared_ptr<const RenderScene>
  build(const Document& document, const RenderScene* previous = nullptr, Progress* progress = nullptr);
  /// The same with geometry that was made of the document's instances.
  static std::shared_ptr<const RenderScene> build(const Document& document,
                                                  std::shared_ptr<const Geometry> geometry,
                                                  const RenderScene* previous, Progress* progress = nullptr);

  const std::vector<Instance>& instances() const { return instances_; }
  const std::shared_ptr<const Geometry>& shared_geometry() const { return geometry_; }
  const Geometry& geometry() const { return *geometry_; }
  const SurfaceMaterial& material(std::uint32_t index) const { return materials_[index]; }
  /// Whether any surface lets light straight through, so that rays must look.
  bool has_transparency() const { return has_transparency_; }
  /// Whether light fades on its way through any body, so that rays must know where they are.
  bool has_absorption() const { return !absorptions_.empty(); }
  /// sigma_a of an interior, 1/scene unit.
  vec3 absorption(std::uint16_t interior) const { return absorptions_[interior]; }

  const std::vector<Light>& lights() const { return lights_; }
  /// The light that a primitive is (part of), or kNoLight.
  std::uint32_t light_of(std::uint64_t emitter) const { return light_of_emitter_[emitter]; }
  /// Whether any of the lights, by index, sends out what a texture says, so that samples of it must look.
  bool has_textured_lights() const { return !emitter_textures_.empty(); }
  /// Of that light; null where its radiance is the same everywhere.
  const EmitterTexture* emitter_texture(std::uint32_t light) const {
    return emitter_textures_.size() > light && emitter_textures_[light].material != nullptr
               ? &emitter_textures_[light]
               : nullptr;
  }
  const std::vector<std::uint32_t>& infinite_lights() const { return infinite_lights_; }

  /// Choice of a light as path.light_choice has it: among all, or among those that no direction can hit by
  /// chance.
  const LightSelection& all_lights() const { return all_lights_; }
  const LightSelection& delta_lights() const { return delta_lights_; }

  std::size_t memory_bytes() const;

private:
  std::shared_ptr<const Geometry> geometry_;
  std::vector<Instance> instances_; ///< what geometry_ was built from
  std::vector<std::shared_ptr<const Texture>> textures_;
  SurfaceMaterials materials_;
  std::vector<Light> lights_;
  EmitterLights light_of_emitter_;
  std::vector<EmitterTexture> emitter_textures_; ///< by light; empty where none is textured
  std::vector<std::uint32_t> infinite_lights_;
  std::vector<std::shared_ptr<const EnvironmentMap>> environment_maps_; ///< what lights_ point to
  LightSelection all_lights_, delta_lights_;
  bool has_transparency_ = false;
  std::vector<vec3> absorptions_; ///< by interior; empty where nothing absorbs

  void add_materials(const Document& document);
  void add_interiors(const std::vector<const Material*>& materials);
  void add_emitters(const Progress* progress);
  void add_emitter(std::uint64_t emitter, const SurfaceMaterial& material, Light light);
  void add_lights(const std::vector<LightDesc>& lights, const RenderScene* previous,
                  const Progress* progress);
  const EnvironmentMap* environment_map(const LightDesc& light, const RenderScene* previous,
                                        const Progress* progress);
};

} // namespace candela
