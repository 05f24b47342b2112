#pragma once
// The parts of a RenderScene that edits of other parts keep: materials and lights. Each knows what it was
// made of.

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

/// A document's materials.
class SceneMaterials {
public:
  explicit SceneMaterials(const Document& document);
  /// Those of `previous` (may be null) where they are of the same materials, textures and override.
  static std::shared_ptr<const SceneMaterials> of(const Document& document,
                                                  std::shared_ptr<const SceneMaterials> previous);

  const SurfaceMaterial& operator[](std::size_t i) const { return materials_[i]; }
  std::size_t size() const { return materials_.size(); }
  auto begin() const { return materials_.begin(); }
  auto end() const { return materials_.end(); }
  bool has_transparency() const { return has_transparency_; }
  const std::vector<Medium>& media() const { return media_; }
  std::size_t memory_bytes() const;

private:
  void add_materials(const Document& document);
  void add_media(const std::vector<Material>& materials);

  // Made of:
  std::vector<Material> source_;
  std::vector<std::shared_ptr<const Texture>> textures_;
  OverrideSettings override_;

  std::vector<SurfaceMaterial> materials_;
  bool has_transparency_ = false;
  std::vector<Medium> media_; ///< empty where nothing absorbs
};

/// A document's lights, those of surfaces that emit among them, and the choices of one.
class SceneLights {
public:
  /// Environment maps of `previous` (may be null) serve again.
  SceneLights(const Document& document, std::shared_ptr<const Geometry> geometry,
              std::shared_ptr<const SceneMaterials> materials, const SceneLights* previous,
              const Progress* progress);
  SceneLights(const SceneLights&) = delete;
  SceneLights& operator=(const SceneLights&) = delete;
  /// Those of `previous` (may be null) where they are of the same geometry, lights and emitting materials.
  static std::shared_ptr<const SceneLights> of(const Document& document,
                                               const std::shared_ptr<const Geometry>& geometry,
                                               const std::shared_ptr<const SceneMaterials>& materials,
                                               std::shared_ptr<const SceneLights> previous,
                                               const Progress* progress);

  const std::vector<Light>& lights() const { return lights_; }
  std::uint32_t light_of(std::uint64_t emitter) const { return light_of_emitter_[emitter]; }
  const std::vector<std::uint32_t>& infinite_lights() const { return infinite_lights_; }
  const LightSelection& all_lights() const { return all_lights_; }
  const LightSelection& delta_lights() const { return delta_lights_; }
  std::size_t memory_bytes() const;

private:
  void add_emitters(const Progress* progress);
  void add_lights(const std::vector<LightDesc>& lights, const SceneLights* previous,
                  const Progress* progress);
  const EnvironmentMap* environment_map(const LightDesc& light, const SceneLights* previous,
                                        const Progress* progress);
  void add_selections(const Progress* progress);

  // Made of:
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const SceneMaterials> kept_materials_;
  const SceneMaterials& materials_; ///< *kept_materials_
  std::vector<LightDesc> source_;
  LightChoiceBy light_choice_;

  std::vector<Light> lights_;
  EmitterLights light_of_emitter_;
  std::vector<std::uint32_t> infinite_lights_;
  std::vector<std::shared_ptr<const EnvironmentMap>> environment_maps_; ///< what lights_ point to
  LightSelection all_lights_, delta_lights_;
};

} // namespace candela
