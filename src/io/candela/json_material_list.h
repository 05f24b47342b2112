#pragma once
// "textures" and "materials" of Candela JSON, and references to their entries.

#include "io/candela/json_material.h"
#include "io/candela/json_source.h"

#include <map>
#include <string>

namespace candela {

class JsonMaterialList {
public:
  explicit JsonMaterialList(const JsonSource& source) : source_(source) {}

  // The members of the scene's object, textures first.
  void read_textures(JsonValue array);
  void read_materials(JsonValue array);

  /// The material that a name or an index stands for. Throws input_error.
  int material_of(JsonValue value, const std::string& element) const;

private:
  /// Sets the parts of the material of that index.
  void set_parts(int material, const std::vector<JsonMaterialPart>& parts);
  void check_parts(const std::vector<std::pair<int, std::vector<JsonMaterialPart>>>& parts) const;
  int texture_file_or_index(JsonValue value, const std::string& element) const;
  int texture_of(JsonValue value, const std::string& element) const;

  static constexpr int kAmbiguous = -2;

  const JsonSource& source_;
  std::map<std::string, int> texture_by_name_; ///< of entries of "textures" that have one
  std::map<std::string, int> material_by_name_;
  int material_count_ = 0; ///< of the file's own, without imported ones
};

} // namespace candela
