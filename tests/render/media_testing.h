#pragma once
// Scenes with media, for the tests of light in them.

#include "render/render_testing.h"
#include "support/volumes.h"

namespace candela::test {

/// A medium of the scene; returns its name.
inline std::string add_medium(SceneMaker& s, vec3 sigma_t, vec3 albedo,
                              const PhaseModel& phase = IsotropicPhase{}) {
  MediumDesc medium;
  medium.name = "medium " + std::to_string(s.document.scene.media.size());
  medium.model = HomogeneousMediumModel{sigma_t, albedo};
  medium.phase.model = phase;
  s.document.scene.media.push_back(medium);
  return medium.name;
}

/// A medium of the scene that is a grid in a box; returns its name.
inline std::string add_grid(SceneMaker& s, VolumeGrid grid, vec3 center, vec3 size, vec3 sigma_t, vec3 albedo,
                            const PhaseModel& phase = IsotropicPhase{}) {
  const std::string name = add_medium(s, sigma_t, albedo, phase);
  GridMediumModel model;
  model.center = center, model.size = size, model.sigma_t = sigma_t, model.albedo = albedo;
  model.grid = std::make_shared<const VolumeGrid>(std::move(grid));
  s.document.scene.media.back().model = model;
  return name;
}

/// A surface that is not there around a medium.
inline int boundary(SceneMaker& s, const std::string& medium) {
  Material m;
  m.model = NullMaterial{};
  m.medium = medium;
  return s.material(m);
}

/// A slab -depth < z < 0 that is wide enough to seem infinite from near its middle.
inline void add_slab(SceneMaker& s, float depth, int material, float half_width = 500) {
  Instance slab;
  slab.shape = CubeShape{};
  slab.world_from_object = glm::translate(mat4(1), {0, 0, -0.5f * depth}) *
                           glm::scale(mat4(1), {half_width, half_width, 0.5f * depth});
  slab.materials = {material};
  s.document.scene.instances.push_back(slab);
}

inline void add_directional(SceneMaker& s, vec3 direction, vec3 irradiance) {
  LightDesc sun;
  sun.model = DirectionalLightModel{direction};
  sun.color = irradiance;
  s.document.scene.lights.push_back(sun);
}

/// The sum over all pixels, and its variance.
struct RenderedSum {
  glm::dvec3 value{0}, variance{0};
};
inline RenderedSum sum_of(const Document& document) {
  const Film film = render(document);
  RenderedSum sum;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      sum.value += glm::dvec3(film.mean(x, y));
      sum.variance += glm::dvec3(film.variance_of_mean(x, y));
    }
  return sum;
}

/// A floor and a wall in a great ball of coloured fog, with a ball of denser smoke, a lamp with an area, a
/// directional light and a sky, a glossy ball and a ball of glass with milk in it; if `cloudy`, with a cloud
/// and a thin plume of grids. No point light: where
/// places are not chosen for its sake it has no finite variance.
inline SceneMaker foggy_room(int size, int spp, bool cloudy = false) {
  SceneMaker s(size, size, spp);
  const std::string fog = add_medium(s, {0.15f, 0.3f, 0.6f}, {0.9f, 0.7f, 0.5f}, HenyeyGreensteinPhase{0.4f});
  const std::string smoke = add_medium(s, {3, 2, 1}, {0.4f, 0.8f, 0.9f}, HenyeyGreensteinPhase{-0.4f});
  const std::string milk = add_medium(s, {5, 7, 9}, vec3(0.95f));
  s.sphere({0, 0, 0}, 3, boundary(s, fog));
  const int wall = s.diffuse({0.7f, 0.6f, 0.4f});
  s.rectangle({0, -1, 0}, {0, 0, 2}, {2, 0, 0}, wall);
  s.rectangle({0, 0, -1.5f}, {2, 0, 0}, {0, 2, 0}, wall);
  s.rectangle({0, 1.9f, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, s.diffuse(vec3(0), vec3(8, 6, 4)));
  s.sphere({-0.8f, 0, 0}, 0.7f, boundary(s, smoke));
  Material glass;
  glass.model = DielectricMaterial{.ior = 1.3f};
  glass.medium = milk;
  s.sphere({0.9f, -0.3f, 0.2f}, 0.6f, s.material(glass));
  Material gloss;
  gloss.model = GgxMaterial{};
  s.sphere({0.1f, -0.6f, 1}, 0.35f, s.material(gloss));
  if (cloudy) {
    const std::string cloud = add_grid(s, wavy_grid({20, 17, 30}), {0.5f, 1, 0.2f}, vec3(0.9f), {8, 6, 3},
                                       {0.95f, 0.9f, 0.99f}, HenyeyGreensteinPhase{0.5f});
    s.sphere({0.5f, 1, 0.2f}, 0.6f, boundary(s, cloud));
    const std::string plume = add_grid(s, wavy_grid({9, 40, 9}), {-1.2f, -0.1f, 1.4f}, {0.5f, 1.2f, 0.5f},
                                       {0.5f, 1, 2}, vec3(0.7f));
    s.sphere({-1.2f, -0.1f, 1.4f}, 0.7f, boundary(s, plume));
  }
  add_directional(s, {0.3f, -1, -0.5f}, {1, 0.9f, 0.7f});
  s.constant_light({0.1f, 0.15f, 0.3f});
  s.camera({0, 0.4f, 1.9f}, {0, 0.1f, 0}, 60);
  s.document.settings.sampler.type = SamplerType::independent;
  return s;
}

} // namespace candela::test
