#pragma once
// Shared by all scene readers: files are read once, and materials of OBJ files are imported.

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

  /// Announces a file that will be read, named in a file of `folder`, for the progress. Errors are reported
  /// when it is read.
  void expect_file(const std::string& reference, const std::string& folder);

  /// The mesh of a file (OBJ by its ending) under a name; "": the file's own name. A file is read once and
  /// has one Mesh per name.
  MeshFile& mesh_file(const FoundFile& file, const std::string& name, const Location& where,
                      std::string_view element);

  /// The strands of a binary file (io/curves); a file is read once.
  std::shared_ptr<const Strands> strands(const FoundFile& file);

  /// Index of the picture in SceneDesc::textures; the same file is one texture.
  int texture(const FoundFile& file);
  /// The same for a picture that an exporter named at `where`: -1, with a warning, if it cannot be read.
  int texture_or_none(const FoundFile& file, const Location& where);
  /// Adds a picture at a new index, under a name; "": the file's own name. It shares the texels of an
  /// existing texture with the same ones.
  int append_texture(const FoundFile& file, const std::string& name = "");
  /// Adds a texture that was not read here; `file` is its source and may be null.
  int append_texture(std::shared_ptr<const Texture> texture, const FoundFile* file = nullptr);

  /// The panorama of a file, or of six; the same files are one.
  std::shared_ptr<const Panorama> panorama(const std::vector<FoundFile>& files);

  /// The photometric file; the same file is one.
  std::shared_ptr<const IesProfile> profile(const FoundFile& file);

  /// The file of densities (io/volumes); the same file is one.
  std::shared_ptr<const VolumeGrid> volume(const FoundFile& file);

  int add_material(Material material);
  /// Sets a row of a material that names another one.
  void set_material_part(int material, const MaterialField& row, int part);

  /// Sets the transform of an instance, which has its shape, such that world_from_object applies to the
  /// coordinates of the shape's file (Mesh::origin). Warns if floats cannot represent the mesh's shape there.
  void place(Instance& instance, const glm::dmat4& world_from_object, const Location& where);

  /// The MTL's material of a slot, imported as "mesh/slot" on first use; -1 if the MTL has none.
  int imported_material(MeshFile& file, std::size_t slot);

  /// The index of a grey material for objects without one, created on first use.
  int default_material();
  /// Of a slot whose material is missing, with a warning: the same, or one with the colours of the vertices
  /// of a mesh that has any.
  int missing_material(const MeshFile& file, std::size_t slot, const Location& where);

private:
  int vertex_color_material();
  std::shared_ptr<const Texels> texels_of(const std::string& path);
  std::string unused_material_name(const std::string& wish) const;

  SceneDesc& scene_;
  PathPolicy policy_;
  MtlDialect dialect_;
  WarningList& warnings_;
  std::map<std::string, std::map<std::string, MeshFile>> meshes_; ///< by canonical path, then name
  std::map<std::string, std::shared_ptr<const Strands>> strands_; ///< by canonical path
  std::map<std::string, int> textures_;                           ///< by canonical path
  std::map<std::vector<std::string>, std::shared_ptr<const Panorama>> panoramas_; ///< by canonical paths
  std::map<std::string, std::shared_ptr<const IesProfile>> profiles_;             ///< by canonical path
  std::map<std::string, std::shared_ptr<const VolumeGrid>> volumes_;              ///< by canonical path
  std::unordered_set<std::string> material_names_;
  std::unordered_set<std::string> expected_;        ///< as named in the scene
  std::unordered_set<std::string> broken_textures_; ///< canonical paths
  int default_material_ = -1, vertex_color_material_ = -1;
};

/// Converts a material of OBJ, XML … files and adds it. Returns its index.
int add_mtl_material(SceneBuilder& builder, const MtlMaterial& material, const std::string& name);

/// instance_bounds of all instances.
Bounds3 scene_bounds(const SceneDesc& scene);

/// Of a shape alone, in its own space.
Bounds3 object_bounds(const Shape& shape);

/// Whether the scene has a light or an instance with an emitting material.
bool has_light(const SceneDesc& scene);

/// Places the camera in front of the bounds (+z), slightly above, so that they fit into the picture.
void frame_camera(Camera& camera, const Bounds3& bounds);

} // namespace candela
