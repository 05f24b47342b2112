#pragma once
// "meshes" and "instances" of Candela JSON.

#include "io/candela/json_material_list.h"

#include <map>
#include <memory>
#include <string>

namespace candela {

class JsonInstanceList {
public:
  JsonInstanceList(const JsonSource& source, const JsonMaterialList& materials)
      : source_(source), materials_(materials) {}

  // The members of the scene's object, meshes first; the materials must have been read.
  void read_meshes(JsonValue object);
  void read_instances(JsonValue array);

private:
  using Parts = std::map<std::string_view, JsonValue>; ///< members of an instance by their keys

  /// A mesh that instances may use, and its file if it has one (for the materials of its MTL).
  struct NamedMesh {
    std::shared_ptr<const Mesh> mesh;
    MeshFile* file = nullptr;
  };

  NamedMesh mesh_of_file(JsonValue value, const std::string& name, const std::string& element);
  NamedMesh deforming_mesh(JsonValue begin, JsonValue end, const std::string& name,
                           const std::string& element);
  Motion read_motion(JsonValue object, const std::string& element) const;
  void read_instance(JsonValue object, const std::string& element);
  std::shared_ptr<const Strands> read_strands(const Parts& parts, JsonValue object,
                                              const std::string& element) const;
  NamedMesh mesh_part(JsonValue object, const JsonValue* mesh, const JsonValue* file,
                      const std::string& element);
  void read_instance_materials(Instance& out, const JsonValue* all, const JsonValue* by_slot, MeshFile* file,
                               JsonValue object, const std::string& element);

  const JsonSource& source_;
  const JsonMaterialList& materials_;
  std::map<std::string, NamedMesh> meshes_;
};

} // namespace candela
