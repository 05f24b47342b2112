#pragma once
// Scenes with media, for the tests of light in them.

#include "render/render_testing.h"

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

} // namespace candela::test
