#pragma once
// What all scene readers do alike: files are read once and shared, materials of OBJ files are imported.

#include "io/obj/obj_reader.h"
#include "scene/scene_desc.h"

#include <map>
#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

namespace candela {

/// A mesh file in use, under one name.
struct MeshFile {
  std::shared_ptr<const Mesh> mesh;
  std::vector<std::optional<MtlMaterial>> mtl; ///< by slot
  std::vector<int> imported;                   ///< by slot: index into SceneDesc::materials, -1: not yet
};

/// Adds to a SceneDesc. Errors are those of the files it reads.
class SceneBuilder {
public:
  SceneBuilder(SceneDesc& scene, PathPolicy policy, MtlDialect dialect, WarningList& warnings)
      : scene_(scene), policy_(std::move(policy)), dialect_(dialect), warnings_(warnings) {}

  SceneDesc& scene() { return scene_; }
  const PathPolicy& policy() const { return policy_; }
  WarningList& warnings() { return warnings_; }

  /// Counts a file, named in one of `folder`, that will be read. What is wrong with it is said then.
  void expect_file(const std::string& reference, const std::string& folder);

  /// The mesh of a file (OBJ by its ending) under a name, "" for the file's own. The same file is read once,
  /// and one name of it is one Mesh.
  MeshFile& mesh_file(const FoundFile& file, const std::string& name, const Location& where,
                      std::string_view element);

  /// Index of the picture in SceneDesc::textures; the same file is one texture.
  int texture(const FoundFile& file);
  /// The same for one that an exporter named at `where`: -1, with a warning, if it cannot be read.
  int texture_or_none(const FoundFile& file, const Location& where);
  /// Of a picture at a new index in any case, under a name; "" for the file's own. What shows the same as a
  /// texture that is there shares its texels.
  int append_texture(const FoundFile& file, const std::string& name = "");
  /// Of one that was not read here; `file`, which may be null, is where it comes from.
  int append_texture(std::shared_ptr<const Texture> texture, const FoundFile* file = nullptr);

  /// The panorama of a file, or of six; the same files are one.
  std::shared_ptr<const Panorama> panorama(const std::vector<FoundFile>& files);

  int add_material(Material material);

  /// Puts an instance, which has its shape, where world_from_object takes the coordinates of the shape's file
  /// (Mesh::origin). A mesh whose shape floats cannot hold there is a warning that tells the loss.
  void place(Instance& instance, const glm::dmat4& world_from_object, const Location& where);

  /// The MTL's material of a slot, imported as "mesh/slot" when first asked for; -1 where the MTL has none.
  int imported_material(MeshFile& file, std::size_t slot);

  /// A grey one for what has no material, made when first asked for.
  int default_material();
  /// The same for a slot that ought to have one, with a warning.
  int missing_material(const MeshFile& file, std::size_t slot, const Location& where);

private:
  std::shared_ptr<const Texels> texels_of(const std::string& path);
  std::string unused_material_name(const std::string& wish) const;

  SceneDesc& scene_;
  PathPolicy policy_;
  MtlDialect dialect_;
  WarningList& warnings_;
  std::map<std::string, std::map<std::string, MeshFile>> meshes_; ///< by canonical path, then name
  std::map<std::string, int> textures_;                           ///< by canonical path
  std::map<std::vector<std::string>, std::shared_ptr<const Panorama>> panoramas_; ///< by canonical paths
  std::unordered_set<std::string> material_names_;
  std::unordered_set<std::string> expected_;        ///< as they are named
  std::unordered_set<std::string> broken_textures_; ///< canonical paths
  int default_material_ = -1;
};

/// The index of the picture for a material made from OBJ, XML…: the readers' MtlMaterial -> Material.
int add_mtl_material(SceneBuilder& builder, const MtlMaterial& material, const std::string& name);

/// instance_bounds of all instances.
Bounds3 scene_bounds(const SceneDesc& scene);

/// Of a shape alone, in its own space.
Bounds3 object_bounds(const Shape& shape);

/// Whether anything shines: a light, or an instance with an emitting material.
bool has_light(const SceneDesc& scene);

/// Looks at the bounds from the front (+z), a little above, so that all is in the picture.
void frame_camera(Camera& camera, const Bounds3& bounds);

} // namespace candela
