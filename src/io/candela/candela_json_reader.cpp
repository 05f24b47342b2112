#include "io/candela/candela_json.h"
#include "io/candela/json_camera.h"
#include "io/candela/json_fields.h"
#include "io/candela/json_light.h"
#include "io/candela/json_material.h"
#include "io/candela/json_mesh.h"
#include "io/candela/json_texture.h"
#include "io/candela/json_transform.h"
#include "io/files/text_file.h"

#include <fmt/format.h>

#include <optional>

namespace candela {

namespace {

constexpr std::size_t kMaxJsonBytes = std::size_t{512} << 20;

class CandelaReader {
public:
  CandelaReader(std::string text, const FoundFile& file, const PathPolicy& policy, WarningList& warnings)
      : folder_(folder_of(file.shown)), progress_(warnings.part(file.canonical, text.size())),
        tree_(file.shown, std::move(text), &progress_, kTreeShare),
        builder_(document_.scene, policy, MtlDialect::standard, warnings) {}

  Document run() {
    constexpr std::string_view kKeys[] = {"candela", "description", "camera", "bookmarks", "materials",
                                          "lights",  "textures",    "meshes", "instances", "settings"};
    JsonValue root = tree_.root();
    expect(root, JsonType::object, "scene");
    std::map<std::string, JsonValue> parts;
    for (auto [key, value] : root.members()) {
      if (std::ranges::find(kKeys, key.string()) == std::end(kKeys)) throw unknown_key(key, "scene", kKeys);
      parts.emplace(key.string(), value);
    }
    if (!parts.contains("candela"))
      throw input_error(root.where(), "scene", "the key \"candela\" is missing",
                        "say \"candela\": 1, the version of the format, in the outermost object");
    read_integer(parts.at("candela"), "candela", 1, 1);
    if (auto it = parts.find("description"); it != parts.end()) {
      expect(it->second, JsonType::string, "description");
      document_.scene.description = it->second.string();
    }
    expect_files(root);
    // What is referred to comes first, whatever the order in the file.
    auto read = [&](const char* key, void (CandelaReader::*reader)(JsonValue)) {
      if (auto it = parts.find(key); it != parts.end()) (this->*reader)(it->second);
    };
    read("settings", &CandelaReader::settings);
    read("camera", &CandelaReader::camera);
    read("bookmarks", &CandelaReader::bookmarks);
    read("textures", &CandelaReader::textures);
    read("materials", &CandelaReader::materials);
    read("lights", &CandelaReader::lights);
    read("meshes", &CandelaReader::meshes);
    read("instances", &CandelaReader::instances);
    return std::move(document_);
  }

private:
  /// A mesh that instances may use, and its file if it has one (for the materials of its MTL).
  struct NamedMesh {
    std::shared_ptr<const Mesh> mesh;
    MeshFile* file = nullptr;
  };

  /// Counts what will be read.
  void expect_files(JsonValue value) {
    progress_.check();
    auto expect_named = [&](JsonValue name) {
      if (name.type() == JsonType::string) builder_.expect_file(name.string(), folder_);
    };
    if (value.type() == JsonType::object) {
      for (auto [key, part] : value.members()) {
        if (key.string() == "file" || key.string() == "texture" || key.string() == "diffuse_texture")
          expect_named(part);
        else if (key.string() == "files" && part.type() == JsonType::array)
          for (JsonValue name : part) expect_named(name);
        else
          expect_files(part);
      }
    } else if (value.type() == JsonType::array) {
      for (JsonValue part : value) {
        progress_.check();
        if (part.type() == JsonType::object) expect_files(part);
      }
    }
  }

  /// To be called for each part of the file that may be one of many, or large.
  void reach(JsonValue value) {
    progress_.reach(kTreeShare + (1 - kTreeShare) * static_cast<double>(value.offset()) /
                                     static_cast<double>(tree_.size()));
  }

  void settings(JsonValue object) { settings_below(object, "settings", ""); }

  /// Reads the settings whose keys begin with `prefix`.
  void settings_below(JsonValue object, const std::string& element, const std::string& prefix) {
    expect(object, JsonType::object, element);
    for (auto [key, value] : object.members()) {
      std::string full = prefix + key.string(), name = fmt::format("{}.{}", element, key.string());
      std::vector<std::string_view> known; // the keys that fit here
      bool is_group = false;
      for (const auto& row : settings_table()) {
        if (row.key.starts_with("camera.") || !row.key.starts_with(prefix)) continue;
        std::string_view next = row.key.substr(prefix.size());
        next = next.substr(0, next.find('.'));
        if (known.empty() || known.back() != next) known.push_back(next);
        is_group |= row.key.starts_with(full + ".");
      }
      const auto* row = find_setting(full);
      if (is_group)
        settings_below(value, name, full + ".");
      else if (row != nullptr && std::ranges::find(known, key.string()) != known.end())
        read_field(*row, row->address(document_), value, name);
      else if (full == "camera")
        throw input_error(key.where(), element, "the camera is no setting",
                          "write \"camera\" beside \"settings\"");
      else
        throw unknown_key(key, element, known);
    }
  }

  void camera(JsonValue object) { document_.scene.camera = read_json_camera(object, "camera"); }
  void bookmarks(JsonValue array) { document_.scene.bookmarks = read_json_bookmarks(array); }

  /// Calls visit(object, element) for each element of an array of objects.
  template <class Visit>
  void each_object(JsonValue array, std::string_view element, Visit visit) {
    expect(array, JsonType::array, element);
    int index = 0;
    for (JsonValue object : array) {
      reach(object);
      std::string name = fmt::format("{}[{}]", element, index++);
      expect(object, JsonType::object, name);
      visit(object, name);
    }
  }

  void textures(JsonValue array) {
    each_object(array, "textures", [&](JsonValue object, const std::string& element) {
      JsonTexture texture = read_json_texture(object, element, builder_.warnings());
      int index = -1;
      if (texture.file) {
        std::string name = element + ".file";
        index = builder_.append_texture(
            builder_.policy().require(read_string(*texture.file, name), folder_, texture.file->where(), name),
            texture.name);
      } else {
        index = builder_.append_texture(std::move(texture.texture));
      }
      if (!texture.name.empty()) texture_by_name_.try_emplace(texture.name, index);
    });
  }

  void materials(JsonValue array) {
    const JsonTextureNames textures = {
        [&](JsonValue value, const std::string& element) { return texture_file_or_index(value, element); },
        [&](JsonValue value, const std::string& element) { return texture_of(value, element); }};
    each_object(array, "materials", [&](JsonValue object, const std::string& element) {
      const Material material = read_json_material(object, element, textures);
      int index = builder_.add_material(material);
      auto [same_name, is_new] = material_by_name_.try_emplace(material.name, index);
      if (!is_new) same_name->second = kAmbiguous;
      ++material_count_;
    });
  }

  int texture_file_or_index(JsonValue value, const std::string& element) {
    if (value.type() == JsonType::number)
      return read_integer(value, element, 0, static_cast<int>(document_.scene.textures.size()) - 1);
    return builder_.texture(
        builder_.policy().require(read_string(value, element), folder_, value.where(), element));
  }
  int texture_of(JsonValue value, const std::string& element) {
    if (value.type() == JsonType::string)
      if (auto named = texture_by_name_.find(value.string()); named != texture_by_name_.end())
        return named->second;
    return texture_file_or_index(value, element);
  }

  void lights(JsonValue array) {
    each_object(array, "lights", [&](JsonValue object, const std::string& element) {
      document_.scene.lights.push_back(read_json_light(object, element, builder_, folder_));
    });
  }

  void meshes(JsonValue object) {
    expect(object, JsonType::object, "meshes");
    for (auto [key, value] : object.members()) {
      reach(value);
      std::string element = fmt::format("meshes.{}", key.string().substr(0, 60));
      expect(value, JsonType::object, element);
      std::string name = key.string();
      std::optional<JsonValue> file;
      for (auto [part_key, part_value] : value.members()) {
        if (part_key.string() == "name") name = read_string(part_value, element + ".name");
        if (part_key.string() == "file") file = part_value;
      }
      if (!file) {
        meshes_[key.string()] = {
            std::make_shared<const Mesh>(read_json_mesh(value, name, element, builder_.warnings())), nullptr};
        continue;
      }
      constexpr std::string_view kKeys[] = {"file", "name"};
      for (auto [part_key, part_value] : value.members())
        if (std::ranges::find(kKeys, part_key.string()) == std::end(kKeys))
          throw unknown_key(part_key, element, kKeys);
      meshes_[key.string()] = mesh_of_file(*file, name, element + ".file");
    }
  }

  NamedMesh mesh_of_file(JsonValue value, const std::string& name, const std::string& element) {
    FoundFile found = builder_.policy().require(read_string(value, element), folder_, value.where(), element);
    MeshFile& file = builder_.mesh_file(found, name, value.where(), element);
    return {file.mesh, &file};
  }

  void instances(JsonValue array) {
    each_object(array, "instances",
                [&](JsonValue object, const std::string& element) { instance(object, element); });
  }

  void instance(JsonValue object, const std::string& element) {
    constexpr std::string_view kKeys[] = {"name",     "shape",        "mesh",      "file",
                                          "material", "materials",    "transform", "radius",
                                          "height",   "minor_radius", "caps"};
    std::map<std::string_view, JsonValue> parts;
    for (auto [key, value] : object.members()) {
      auto known = std::ranges::find(kKeys, key.string());
      if (known == std::end(kKeys)) throw unknown_key(key, element, kKeys);
      parts.emplace(*known, value);
    }
    auto part = [&](std::string_view key) -> const JsonValue* {
      auto found = parts.find(key);
      return found == parts.end() ? nullptr : &found->second;
    };
    Instance out;
    if (const auto* name = part("name")) out.name = read_string(*name, element + ".name");
    glm::dmat4 world_from_object(1);
    if (const auto* transform = part("transform"))
      world_from_object = read_transform(*transform, element + ".transform");

    bool names_mesh = part("mesh") || part("file");
    const auto* shape = part("shape");
    if (!shape && !names_mesh)
      throw input_error(object.where(), element, "it has no shape",
                        fmt::format("give a \"shape\": {}", fmt::join(shape_names(), ", ")));
    std::string kind = shape ? read_string(*shape, element + ".shape") : "mesh";
    if (kind != "mesh" && names_mesh)
      throw input_error((part("mesh") ? part("mesh") : part("file"))->where(), element,
                        fmt::format("a {} has no mesh", kind), "leave it out, or say \"shape\": \"mesh\"");
    MeshFile* file = nullptr;
    if (kind == "mesh") {
      NamedMesh mesh = mesh_part(object, part("mesh"), part("file"), element);
      file = mesh.file;
      out.shape = std::move(mesh.mesh);
    } else if (auto standard = shape_of_name(kind)) {
      out.shape = *standard;
    } else {
      throw input_error(shape->where(), element + ".shape",
                        fmt::format("there is no shape '{}'", kind.substr(0, 60)),
                        fmt::format("give one of {}", fmt::join(shape_names(), ", ")));
    }
    shape_values(out.shape, parts, object, element);
    builder_.place(out, world_from_object, object.where());
    instance_materials(out, part("material"), part("materials"), file, object, element);
    document_.scene.instances.push_back(std::move(out));
  }

  /// The values of the shape's kind; those of other kinds are errors.
  static void shape_values(Shape& shape, const std::map<std::string_view, JsonValue>& parts, JsonValue object,
                           const std::string& element) {
    auto rows = shape_fields(shape);
    for (std::string_view key : {"radius", "height", "minor_radius", "caps"}) {
      auto given = parts.find(key);
      if (given == parts.end()) continue;
      auto row = std::ranges::find(rows, key, &FieldInfo::key);
      if (row == rows.end())
        throw input_error(given->second.where(), element,
                          fmt::format("a {} has no {}", shape_name(shape), key),
                          "leave it out; a transform scales any shape");
      read_field(*row, row->address(shape), given->second, fmt::format("{}.{}", element, key));
    }
    std::string problem = shape_problem(shape);
    if (problem.empty()) return;
    std::string_view key = std::string_view(problem).substr(0, problem.find(':'));
    auto given = parts.find(key);
    throw input_error((given == parts.end() ? object : given->second).where(),
                      fmt::format("{}.{}", element, key), problem.substr(key.size() + 2),
                      "correct it, or scale the shape by its transform");
  }

  NamedMesh mesh_part(JsonValue object, const JsonValue* mesh, const JsonValue* file,
                      const std::string& element) {
    if (mesh && file)
      throw input_error(file->where(), element, "it has both a mesh and a file", "keep one of them");
    if (file) return mesh_of_file(*file, "", element + ".file");
    if (!mesh) throw input_error(object.where(), element, "it names no mesh", "give \"mesh\" or \"file\"");
    std::string name = read_string(*mesh, element + ".mesh");
    auto known = meshes_.find(name);
    if (known != meshes_.end()) return known->second;
    std::vector<std::string_view> names;
    for (const auto& [key, value] : meshes_) names.push_back(key);
    throw missing(*mesh, element + ".mesh", "mesh", name, names);
  }

  void instance_materials(Instance& out, const JsonValue* all, const JsonValue* by_slot, MeshFile* file,
                          JsonValue object, const std::string& element) {
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&out.shape);
    const std::vector<std::string> one{""};
    const std::vector<std::string>& slots = mesh ? (*mesh)->slot_names : one;
    out.materials.assign(slots.size(), all ? material_of(*all, element + ".material") : -1);
    if (by_slot) {
      std::string name = element + ".materials";
      if (by_slot->type() == JsonType::array) {
        if (by_slot->size() != slots.size())
          throw input_error(by_slot->where(), name,
                            fmt::format("{} materials for {} slots", by_slot->size(), slots.size()),
                            "give one for each slot");
        auto slot = out.materials.begin();
        for (JsonValue value : *by_slot) *slot++ = material_of(value, name);
      } else {
        expect(*by_slot, JsonType::object, name);
        for (auto [key, value] : by_slot->members()) {
          auto slot = std::ranges::find(slots, key.string());
          std::vector<std::string_view> names(slots.begin(), slots.end());
          if (slot == slots.end()) throw unknown_key(key, name, names);
          out.materials[static_cast<std::size_t>(slot - slots.begin())] =
              material_of(value, fmt::format("{}.{}", name, key.string()));
        }
      }
    }
    for (std::size_t slot = 0; slot < out.materials.size(); ++slot) {
      int& material = out.materials[slot];
      if (material < 0 && file) {
        material = builder_.imported_material(*file, slot);
        if (material < 0) material = builder_.missing_material(*file, slot, object.where());
      }
      if (material < 0) material = builder_.default_material();
    }
  }

  int material_of(JsonValue value, const std::string& element) {
    // By index only those of the file: imported ones come in an order that is nobody's promise.
    if (value.type() == JsonType::number) return read_integer(value, element, 0, material_count_ - 1);
    std::string name = read_string(value, element);
    auto known = material_by_name_.find(name);
    if (known != material_by_name_.end() && known->second != kAmbiguous) return known->second;
    if (known != material_by_name_.end())
      throw input_error(value.where(), element,
                        fmt::format("several materials are called '{}'", name.substr(0, 60)),
                        "give the index of the one that you mean");
    std::vector<std::string_view> names;
    for (const auto& [key, index] : material_by_name_) names.push_back(key);
    throw missing(value, element, "material", name, names);
  }

  static Error missing(JsonValue value, std::string_view element, std::string_view what,
                       const std::string& name, std::span<const std::string_view> names) {
    std::string near = nearest_name(name, names);
    return input_error(value.where(), element, fmt::format("there is no {} '{}'", what, name.substr(0, 60)),
                       near.empty()
                           ? fmt::format("define it in \"{}\"", what == "mesh" ? "meshes" : "materials")
                           : fmt::format("did you mean '{}'?", near));
  }

  static constexpr int kAmbiguous = -2;

  /// Of the time that a file takes, that of its syntax.
  static constexpr double kTreeShare = 0.7;

  std::string folder_;
  ProgressPart progress_;
  JsonTree tree_;
  Document document_;
  SceneBuilder builder_;
  std::map<std::string, int> texture_by_name_; ///< of entries of "textures" that have one
  std::map<std::string, int> material_by_name_;
  int material_count_ = 0; ///< of the file's own, without imported ones
  std::map<std::string, NamedMesh> meshes_;
};

} // namespace

Document read_candela_json(const FoundFile& file, const PathPolicy& policy, WarningList& warnings) {
  warnings.check_stop();
  return CandelaReader(read_text_file(file.canonical, "scene", kMaxJsonBytes, &warnings), file, policy,
                       warnings)
      .run();
}

Document parse_candela_json(std::string text, const std::string& shown, const PathPolicy& policy,
                            WarningList& warnings) {
  return CandelaReader(std::move(text), {shown, shown}, policy, warnings).run();
}

} // namespace candela
