#pragma once
// The parts of a RenderScene that edits of other parts keep: materials and lights. Each knows what it was
// made of.

#include "media/grid_cache.h"
#include "media/medium.h"
#include "render/lights/emitter_lights.h"
#include "render/lights/light_selection.h"
#include "render/world/emission_table.h"
#include "render/world/emitter_texture.h"
#include "render/world/geometry.h"
#include "render/world/scene_portals.h"
#include "render/world/surface_material.h"
#include "scene/light_layers.h"

#include <map>

namespace candela {

/// A document's materials.
class SceneMaterials {
public:
  /// Pyramids of pictures of `previous` (may be null) serve again.
  explicit SceneMaterials(const Document& document, const SceneMaterials* previous = nullptr,
                          const Progress* progress = nullptr);
  SceneMaterials(const SceneMaterials&) = delete;
  SceneMaterials& operator=(const SceneMaterials&) = delete;
  /// Those of `previous` (may be null) where they are of the same materials, textures and override.
  static std::shared_ptr<const SceneMaterials> of(const Document& document,
                                                  std::shared_ptr<const SceneMaterials> previous,
                                                  const Progress* progress = nullptr);

  const SurfaceMaterial& operator[](std::size_t i) const { return materials_[i]; }
  auto begin() const { return materials_.begin(); }
  auto end() const { return materials_.end(); }
  /// Null where there are none.
  const SurfaceMaterial* data() const { return begin() == end() ? nullptr : &*begin(); }
  bool has_transparency() const { return has_transparency_; }
  bool has_invisible() const { return has_invisible_; }
  bool filters_textures() const { return materials_.filters_textures(); }
  const std::vector<Medium>& media() const { return media_; }
  /// What fills the places that lie in no body; none: nothing.
  MediumId world_medium() const { return world_medium_; }
  /// Whether light may leave any surface away from where it enters it.
  bool has_subsurface() const { return has_subsurface_; }
  bool has_scattering() const { return has_scattering_; }
  bool has_medium_emission() const { return has_emission_; }
  /// Parallel to media(): their index of refraction over vacuum.
  const std::vector<float>& media_iors() const { return media_iors_; }
  bool has_priorities() const { return has_priorities_; }
  std::size_t memory_bytes() const;

private:
  void add_materials(const Document& document, const MipPyramidSource& pyramids);
  void add_media(const std::vector<const Material*>& materials);
  std::uint16_t medium_index(const Interior& inside, float ior);

  // Made of:
  std::vector<Material> source_; ///< with the factors of their groups where these are part of the scene
  std::vector<std::shared_ptr<const Texture>> textures_;
  OverrideSettings override_;
  std::vector<MediumDesc> source_media_;
  std::string source_world_; ///< SceneDesc::medium
  TransmittanceEstimator source_estimator_;

  std::vector<std::shared_ptr<const MipPyramid>> pyramids_; ///< what materials_ point to
  SurfaceMaterials materials_;
  bool has_transparency_ = false, has_invisible_ = false, has_priorities_ = false, has_subsurface_ = false;
  GridCache grids_;           ///< of media_
  std::vector<Medium> media_; ///< empty where nothing fills anything, or has a priority
  std::vector<float> media_iors_;
  std::map<std::pair<std::string, std::array<float, 7>>, std::uint16_t> known_media_; ///< medium_index()
  MediumId world_medium_;
  bool has_scattering_ = false, has_emission_ = false; ///< any of the media
};

/// Whether surfaces of either material are the same lights. Textures are compared by their addresses: the
/// parts hold them.
bool emits_alike(const SurfaceMaterial& a, const SurfaceMaterial& b);

/// A document's lights, those of surfaces that emit among them, and the choices of one.
class SceneLights {
public:
  /// Environment maps and tables of emission of `previous` (may be null) serve again.
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
  bool has_textured_lights() const { return !emitter_textures_.empty(); }
  const EmitterTexture* emitter_texture(std::uint32_t light) const {
    return emitter_textures_.size() > light && emitter_textures_[light].material != nullptr
               ? &emitter_textures_[light]
               : nullptr;
  }
  const std::vector<std::uint32_t>& infinite_lights() const { return infinite_lights_; }
  /// What a film keeps apart, and the layer of a light, where it keeps any.
  const LightLayers& layers() const { return layers_; }
  std::uint8_t layer_of(std::uint32_t light) const { return layer_of_light_[light]; }
  const LightSelection& all_lights() const { return all_lights_; }
  const LightSelection& delta_lights() const { return delta_lights_; }
  std::size_t memory_bytes() const;

private:
  /// What a light of the material shows.
  struct ShownEmission {
    const SurfaceMaterial* material;
    EmissionChart chart;
    std::shared_ptr<const EmissionTable> table;
  };

  struct KnownSky {
    SkyParameters parameters;
    std::shared_ptr<const SkyModel> sky;
  };

  void add_emitters(const SceneLights* previous, const Progress* progress);
  const EmissionTable& emission_table(const SurfaceMaterial& material, EmissionChart chart,
                                      const SceneLights* previous, const Progress* progress);
  void add_emitter(std::uint64_t emitter, std::uint32_t material, Light light);
  void add_light(const Light& light, const std::vector<std::uint8_t>& layers, std::size_t index);
  void add_lights(const SceneLights* previous, const Progress* progress);
  const EnvironmentMap* environment_map(const EnvironmentLightModel& light, const SceneLights* previous,
                                        const Progress* progress);
  const SkyModel* sky(const SkyParameters& parameters, const SceneLights* previous, const Progress* progress);
  void add_selections(const Progress* progress);

  // Made of:
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const SceneMaterials> kept_materials_;
  const SceneMaterials& materials_; ///< *kept_materials_
  LightLayers layers_;
  std::vector<LightDesc> source_; ///< as SceneMaterials has it; lights_ point to their files
  LightChoiceBy light_choice_;

  std::vector<Light> lights_;
  std::vector<std::uint8_t> layer_of_light_; ///< parallel to lights_ where there are layers
  EmitterLights light_of_emitter_;
  std::vector<EmitterTexture> emitter_textures_; ///< by light; empty where none is textured
  std::vector<ShownEmission> emission_tables_;   ///< what lights_ point to
  std::vector<std::uint32_t> infinite_lights_;
  std::vector<std::shared_ptr<const EnvironmentMap>> environment_maps_; ///< what lights_ point to
  std::vector<KnownSky> skies_;                                         ///< what environment_maps_ show
  ScenePortals portals_;                                                ///< what lights_ point to
  LightSelection all_lights_, delta_lights_;
};

} // namespace candela
