#pragma once
// A Document made ready to render; const while it is.

#include "bsdf/bsdf.h"
#include "media/medium.h"
#include "media/medium_stack.h"
#include "render/lights/emitter_lights.h"
#include "render/lights/light_selection.h"
#include "render/world/geometry.h"
#include "scene/document.h"

namespace candela {

/// A material as shading needs it.
struct SurfaceMaterial {
  Bsdf bsdf;
  const Texture* diffuse_texture = nullptr; ///< multiplies the BSDF's diffuse part; null: none
  UvTransform diffuse_uv;                   ///< of that texture
  Spectrum emission{0};                     ///< W/(m^2 sr)
  float opacity = 1;
  bool emissive = false;
  bool two_sided_emission = false;
  /// By RenderScene::medium(). Bodies that absorb the same have the same medium; where anything absorbs, a
  /// clear dielectric has one, too, for it may lie inside of that.
  MediumInterface media;
};

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
  /// Whether any body is filled with something, so that rays must know where they are.
  bool has_media() const { return !media_.empty(); }
  const Medium& medium(MediumId id) const { return media_[id.index]; }

  const std::vector<Light>& lights() const { return lights_; }
  /// The light that a primitive is (part of), or kNoLight.
  std::uint32_t light_of(std::uint64_t emitter) const { return light_of_emitter_[emitter]; }
  const std::vector<std::uint32_t>& infinite_lights() const { return infinite_lights_; }

  /// Choice of a light as path.light_choice has it: among all, or among those that light sampling alone can
  /// find.
  const LightSelection& all_lights() const { return all_lights_; }
  const LightSelection& delta_lights() const { return delta_lights_; }

  std::size_t memory_bytes() const;

private:
  std::shared_ptr<const Geometry> geometry_;
  std::vector<Instance> instances_; ///< what geometry_ was built from
  std::vector<std::shared_ptr<const Texture>> textures_;
  std::vector<SurfaceMaterial> materials_;
  std::vector<Light> lights_;
  EmitterLights light_of_emitter_;
  std::vector<std::uint32_t> infinite_lights_;
  std::vector<std::shared_ptr<const EnvironmentMap>> environment_maps_; ///< what lights_ point to
  LightSelection all_lights_, delta_lights_;
  bool has_transparency_ = false;
  std::vector<Medium> media_; ///< empty where nothing absorbs

  void add_materials(const Document& document);
  void add_media(const std::vector<Material>& materials);
  void add_emitters(const Progress* progress);
  void add_lights(const std::vector<LightDesc>& lights, const RenderScene* previous,
                  const Progress* progress);
  const EnvironmentMap* environment_map(const LightDesc& light, const RenderScene* previous,
                                        const Progress* progress);
};

/// The material's BSDF, without its texture.
Bsdf make_bsdf(const Material& material);

/// The BSDF of a material that has a texture, with it looked up at uv.
Bsdf evaluate_bsdf(const SurfaceMaterial& material, vec2 uv);

} // namespace candela
