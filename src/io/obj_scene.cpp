#include "io/obj_scene.h"

#include "io/builder/scene_builder.h"

#include <fmt/format.h>

namespace candela {

Document read_obj_scene(const FoundFile& file, const PathPolicy& policy, WarningList& warnings) {
  Document document;
  SceneBuilder builder(document.scene, policy, MtlDialect::standard, warnings);
  MeshFile& mesh = builder.mesh_file(file, "", {file.shown}, "mesh");
  Instance instance;
  instance.name = mesh.mesh->name;
  instance.shape = mesh.mesh;
  // The mesh is the only object, so its position in the world does not matter.
  if (const glm::dvec3 origin = mesh.mesh->origin; origin != glm::dvec3(0))
    warnings.add({file.shown},
                 fmt::format("it lies far from its origin for its size: ({}, {}, {}) is taken for the origin",
                             static_cast<float>(origin.x), static_cast<float>(origin.y),
                             static_cast<float>(origin.z)));

  for (std::size_t slot = 0; slot < mesh.mesh->slot_names.size(); ++slot) {
    int material = builder.imported_material(mesh, slot);
    if (material < 0) material = builder.missing_material(mesh, slot, {file.shown});
    instance.materials.push_back(material);
  }
  document.scene.instances.push_back(std::move(instance));
  frame_camera(document.scene.camera, scene_bounds(document.scene));
  if (!has_light(document.scene)) {
    LightDesc sky;
    sky.name = "sky";
    sky.model = ConstantLightModel{};
    document.scene.lights.push_back(std::move(sky));
    warnings.add({file.shown}, "nothing emits light: a constant light is added");
  }
  return document;
}

} // namespace candela
