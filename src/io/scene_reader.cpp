#include "io/scene_reader.h"

#include "io/cs123/cs123_reader.h"
#include "io/files/apart.h"
#include "io/files/text_file.h"
#include "io/ini_job.h"
#include "io/picture_state.h"

#include <fmt/format.h>

namespace candela {

namespace {

Document read_obj_scene(const FoundFile& file, const PathPolicy& policy, WarningList& warnings) {
  Document document;
  SceneBuilder builder(document.scene, policy, MtlDialect::standard, warnings);
  MeshFile& mesh = builder.mesh_file(file, "", {file.shown}, "mesh");
  Instance instance;
  instance.name = mesh.mesh->name;
  instance.shape = mesh.mesh;
  // The mesh is all that there is: nothing else has to keep its place beside it.
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
    sky.type = LightType::constant;
    document.scene.lights.push_back(std::move(sky));
    warnings.add({file.shown}, "nothing shines: a constant light is added");
  }
  return document;
}

/// Reads any format but .ini.
Document read_by_ending(const FoundFile& file, const PathPolicy& policy, const Location& where,
                        WarningList& warnings) {
  std::string ending = lower_ending(file.shown);
  if (ending == ".json") return read_candela_json(file, policy, warnings);
  if (ending == ".obj") return read_obj_scene(file, policy, warnings);
  if (ending == ".xml") return read_cs123(file, policy, warnings);
  throw input_error(where, "scene", fmt::format("no scene format is known by the ending '{}'", ending),
                    "give a .json, .obj, .xml or .ini file, or a .png or .exr that Candela saved");
}

/// A scene of its own, or the one of a job.
void read_document(const FoundFile& file, const ReadOptions& options, const Location& where,
                   WarningList& warnings, LoadedScene& loaded) {
  const PathPolicy policy(folder_of(file.shown), options.allow_outside);
  const FileStamp stamp = file_stamp(file.canonical);
  loaded.document = read_by_ending(file, policy, where, warnings);
  loaded.files = policy.asked();
  loaded.files[file.canonical] = stamp;
}

LoadedScene read_here(const std::string& path, const ReadOptions& options) {
  WarningList warnings(options.progress);
  warnings.check_stop();
  LoadedScene loaded;
  const FileStamp stamp = file_stamp(path);
  if (lower_ending(path) == ".ini") {
    IniJob job = read_ini_job(path, options.allow_outside, warnings);
    read_document(job.scene, options, {path}, warnings, loaded);
    loaded.document.settings = job.settings;
    if (!job.output.empty()) loaded.output_files.push_back(job.output);
  } else if (std::string ending = lower_ending(path); ending == ".png" || ending == ".exr") {
    loaded = read_picture_state(path, options, warnings);
  } else {
    // The scene itself may lie anywhere: the user has named it. Opening it says what is wrong with it.
    read_document({path, canonical_path(path)}, options, {path}, warnings, loaded);
  }
  loaded.files[canonical_path(path)] = stamp;
  const SceneDesc& scene = loaded.document.scene;
  if (!has_light(scene)) warnings.add({path}, "nothing in the scene shines: the picture will be black");
  loaded.warnings = warnings.warnings();
  return loaded;
}

} // namespace

LoadedScene read_scene(const std::string& path, const ReadOptions& options) {
  options.progress->check();
  // Readers look at the progress often, but a disk may be slow, and to give gigabytes back takes time, too.
  return run_while([path, options] { return read_here(path, options); }, [&] { options.progress->check(); });
}

} // namespace candela
