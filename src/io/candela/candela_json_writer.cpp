#include "io/candela/candela_json.h"
#include "io/candela/json_camera.h"
#include "io/candela/json_curves.h"
#include "io/candela/json_fields.h"
#include "io/candela/json_light.h"
#include "io/candela/json_material.h"
#include "io/candela/json_medium.h"
#include "io/candela/json_mesh.h"
#include "io/candela/json_profile.h"
#include "io/candela/json_texture.h"
#include "io/files/atomic_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

namespace candela {

namespace fs = std::filesystem;

namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  return fmt::format("{}", fmt::join(parts, separator));
}

class CandelaWriter {
public:
  CandelaWriter(const Document& document, const std::string& folder)
      : document_(document), scene_(document.scene) {
    std::error_code failed;
    folder_ = fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder), failed);
  }

  std::string run() {
    std::vector<std::string> parts = {"  \"candela\": 1"};
    auto add = [&](std::string_view key, std::string_view open, const std::vector<std::string>& items,
                   std::string_view close) {
      if (items.empty()) return;
      parts.push_back(fmt::format("  \"{}\": {}\n    {}\n  {}", key, open, joined(items, ",\n    "), close));
    };
    if (!scene_.description.empty())
      parts.push_back(fmt::format("  \"description\": {}", json_quoted(scene_.description)));
    add("camera", "{", json_camera_members(scene_.camera), "}");
    add("bookmarks", "[", json_bookmarks(scene_.bookmarks), "]");
    natural_textures_ = textures_are_natural();
    if (!natural_textures_) add("textures", "[", textures(), "]");
    std::vector<std::string> media;
    const auto named = [this](const std::string& source) { return picture_path(source); };
    for (const MediumDesc& medium : scene_.media)
      media.push_back(fmt::format("{{{}}}", joined(json_medium_members(medium, named), ", ")));
    add("media", "[", media, "]");
    if (!scene_.medium.empty()) parts.push_back(fmt::format("  \"medium\": {}", json_quoted(scene_.medium)));
    add("materials", "[", materials(), "]");
    add("lights", "[", lights(), "]");
    add("light_groups", "[", light_groups(), "]");
    add("meshes", "{", meshes(), "}");
    add("instances", "[", instances(), "]");
    add("settings", "{", settings(), "}");
    return fmt::format("{{\n{}\n}}\n", joined(parts, ",\n"));
  }

private:
  /// The rows of an owner that differ from those of a default one, as JSON members.
  template <class Owner>
  static std::vector<std::string> changed_rows(std::span<const Field<Owner>> rows, const Owner& owner,
                                               std::string_view prefix = "", const Owner& standard = {}) {
    std::vector<std::string> out;
    for (const auto& row : rows) {
      if (!row.key.starts_with(prefix)) continue;
      const void* value = row.address(const_cast<Owner&>(owner));
      if (field_equal(row, value, row.address(const_cast<Owner&>(standard)))) continue;
      out.push_back(fmt::format("\"{}\": {}", row.key.substr(prefix.size()), field_json(row, value)));
    }
    return out;
  }

  std::vector<std::string> rows_below(std::string_view prefix) const {
    return changed_rows(settings_table(), document_, prefix);
  }

  /// One object for each group of the table ("path." …), and the rows without a group.
  std::vector<std::string> settings() const {
    std::vector<std::string> out;
    std::set<std::string_view> done;
    for (const auto& row : settings_table()) {
      auto dot = row.key.find('.');
      std::string_view group = row.key.substr(0, dot);
      if (group == "camera" || !done.insert(group).second) continue;
      if (dot == std::string_view::npos) {
        for (const std::string& member : rows_below(row.key)) // that row alone: "view"
          out.push_back(fmt::format("\"{}{}", row.key, member.substr(1)));
      } else if (auto members = rows_below(row.key.substr(0, dot + 1)); !members.empty()) {
        out.push_back(fmt::format("\"{}\": {{{}}}", group, joined(members, ", ")));
      }
    }
    return out;
  }

  std::string picture_path(const std::string& source) const {
    std::error_code failed;
    fs::path file = fs::weakly_canonical(fs::absolute(source), failed);
    return (failed ? fs::path(source) : file.lexically_relative(folder_)).generic_string();
  }

  /// Whether the reader, which numbers textures in the order of their first use by materials, would number
  /// them in this way.
  bool textures_are_natural() const {
    std::set<std::string> sources;
    int next = 0;
    for (const auto& texture : scene_.textures)
      if (!is_named_by_file(*texture) || !sources.insert(texture->image()->source).second) return false;
    bool natural = true;
    for (const Material& material : scene_.materials)
      each_parameter(material, [&](const MaterialField&, const ParameterRef& parameter) {
        const int texture = parameter.use().texture;
        natural &= texture <= next;
        if (texture == next) ++next;
      });
    return natural && next == static_cast<int>(scene_.textures.size());
  }

  static bool has_file(const Texture& texture) {
    return texture.image() != nullptr && !texture.image()->source.empty();
  }
  static bool is_named_by_file(const Texture& texture) {
    return has_file(texture) && texture.name == fs::path(texture.image()->source).filename().string();
  }

  std::vector<std::string> textures() const {
    std::vector<std::string> out;
    for (const auto& texture : scene_.textures) {
      if (!has_file(*texture)) {
        out.push_back(json_texture(*texture));
        continue;
      }
      std::string members = fmt::format("\"file\": {}", json_quoted(picture_path(texture->image()->source)));
      if (!is_named_by_file(*texture)) members += fmt::format(", \"name\": {}", json_quoted(texture->name));
      out.push_back(fmt::format("{{{}}}", members));
    }
    return out;
  }

  std::vector<std::string> materials() {
    count_names();
    const JsonReferences references{[&](int i) { return texture_reference(i); },
                                    [&](int i) { return material_reference(i); }};
    std::vector<std::string> out;
    for (const Material& material : scene_.materials)
      out.push_back(fmt::format("{{{}}}", joined(json_material_members(material, references), ", ")));
    return out;
  }

  std::string texture_reference(int index) const {
    if (!natural_textures_) return fmt::format("{}", index);
    return json_quoted(picture_path(scene_.textures[static_cast<std::size_t>(index)]->image()->source));
  }

  std::vector<std::string> lights() const {
    std::vector<std::string> out;
    for (const LightDesc& light : scene_.lights) {
      std::vector<std::string> members;
      if (!light.name.empty()) members.push_back(fmt::format("\"name\": {}", json_quoted(light.name)));
      if (light.model.index() != LightDesc().model.index())
        members.push_back(fmt::format("\"type\": {}", json_quoted(light_type_name(light))));
      for (std::string& row : changed_rows(light_fields(light), light, "", default_light(light_type(light))))
        members.push_back(std::move(row));
      if (!light.group.empty()) members.push_back(fmt::format("\"group\": {}", json_quoted(light.group)));
      if (const auto picture = light_panorama(light)) members.push_back(panorama(*picture));
      if (const auto profile = light_profile(light))
        members.push_back(fmt::format("\"profile\": {}", profile->source.empty()
                                                             ? json_profile(*profile)
                                                             : json_quoted(picture_path(profile->source))));
      out.push_back(fmt::format("{{{}}}", joined(members, ", ")));
    }
    return out;
  }

  std::vector<std::string> light_groups() const {
    std::vector<std::string> out;
    for (const LightGroup& group : scene_.light_groups) {
      std::vector<std::string> members = changed_rows(light_group_fields(), group);
      members.insert(members.begin(), fmt::format("\"name\": {}", json_quoted(group.name)));
      out.push_back(fmt::format("{{{}}}", joined(members, ", ")));
    }
    return out;
  }

  std::string panorama(const Panorama& panorama) const {
    if (panorama.sources.empty()) return json_panorama_member(panorama);
    std::vector<std::string> paths;
    for (const std::string& source : panorama.sources) paths.push_back(json_quoted(picture_path(source)));
    if (paths.size() == 1) return fmt::format("\"file\": {}", paths[0]);
    return fmt::format("\"files\": [{}]", joined(paths, ", "));
  }

  std::vector<std::string> meshes() {
    std::vector<std::string> out;
    std::set<std::string> used;
    for (const Instance& instance : scene_.instances) {
      const auto* shape = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
      if (!shape || mesh_keys_.contains(shape->get())) continue;
      const Mesh& mesh = **shape;
      std::string key = mesh.name.empty() ? "mesh" : mesh.name;
      for (int i = 2; !used.insert(key).second; ++i)
        key = fmt::format("{}-{}", mesh.name.empty() ? "mesh" : mesh.name, i);
      mesh_keys_[&mesh] = key;
      std::string name = key == mesh.name ? "" : fmt::format("\"name\": {}, ", json_quoted(mesh.name));
      const auto path = path_below(folder_.string(), mesh.source),
                 path_end = path_below(folder_.string(), mesh.source_end);
      if (path && (path_end || !mesh.deforms())) {
        by_reference_.insert(&mesh);
        const std::string end =
            mesh.deforms() ? fmt::format(", \"file_end\": {}", json_quoted(*path_end)) : std::string();
        out.push_back(
            fmt::format("{}: {{{}\"file\": {}{}}}", json_quoted(key), name, json_quoted(*path), end));
      } else
        out.push_back(
            fmt::format("{}: {{{}\n{}}}", json_quoted(key), name, json_mesh_members(mesh, "      ")));
    }
    return out;
  }

  std::vector<std::string> instances() {
    std::vector<std::string> out;
    for (const Instance& instance : scene_.instances) {
      std::vector<std::string> members;
      if (!instance.name.empty()) members.push_back(fmt::format("\"name\": {}", json_quoted(instance.name)));
      members.push_back(shape(instance.shape));
      members.push_back(materials_of(instance));
      if (std::string text = transform(instance); !text.empty()) members.push_back(std::move(text));
      if (const auto motion = changed_rows(motion_fields(), instance.motion); !motion.empty())
        members.push_back(fmt::format("\"motion\": {{{}}}", joined(motion, ", ")));
      out.push_back(fmt::format("{{{}}}", joined(members, ", ")));
    }
    return out;
  }

  std::string shape(const Shape& any) const {
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&any))
      return fmt::format("\"shape\": \"mesh\", \"mesh\": {}", json_quoted(mesh_keys_.at(mesh->get())));
    std::vector<std::string> members = {fmt::format("\"shape\": \"{}\"", shape_name(any))};
    Shape standard = *shape_of_name(shape_name(any));
    for (const auto& row : shape_fields(any)) {
      const void* value = row.address(const_cast<Shape&>(any));
      if (!field_equal(row, value, row.address(standard)))
        members.push_back(fmt::format("\"{}\": {}", row.key, field_json(row, value)));
    }
    if (const auto* curves = std::get_if<CurvesShape>(&any)) members.push_back(strands(*curves->strands));
    return joined(members, ", ");
  }

  std::string strands(const Strands& strands) const {
    if (auto path = path_below(folder_.string(), strands.source))
      return fmt::format("\"file\": {}", json_quoted(*path));
    return json_strands_members(strands, "      ");
  }

  void count_names() {
    for (const Material& material : scene_.materials) ++name_count_[material.name];
  }

  std::string material_reference(int index) const {
    const std::string& name = scene_.materials[static_cast<std::size_t>(index)].name;
    return name.empty() || name_count_.at(name) > 1 ? fmt::format("{}", index) : json_quoted(name);
  }

  std::string materials_of(const Instance& instance) const {
    if (instance.materials.size() == 1)
      return fmt::format("\"material\": {}", material_reference(instance.materials[0]));
    const auto& slots = std::get<std::shared_ptr<const Mesh>>(instance.shape)->slot_names;
    bool named = std::set<std::string>(slots.begin(), slots.end()).size() == slots.size();
    std::vector<std::string> items;
    for (std::size_t i = 0; i < slots.size(); ++i)
      items.push_back((named ? json_quoted(slots[i]) + ": " : "") +
                      material_reference(instance.materials[i]));
    return fmt::format("\"materials\": {}{}{}", named ? "{" : "[", joined(items, ", "), named ? "}" : "]");
  }

  /// The transform to the world for the coordinates that the reader will find: for a mesh written by
  /// reference, those of its file. In double precision, since the mesh may be far from the file's origin.
  std::string transform(const Instance& instance) const {
    const mat4& m = instance.world_from_object;
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
    if (mesh && by_reference_.contains(mesh->get()) && (*mesh)->origin != glm::dvec3(0))
      return matrix(glm::translate(glm::dmat4(m), -(*mesh)->origin));
    return m == mat4(1) ? "" : matrix(m);
  }

  template <class Matrix>
  static std::string matrix(const Matrix& m) {
    std::vector<std::string> numbers;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) numbers.push_back(fmt::format("{}", m[c][r]));
    return fmt::format("\"transform\": [{}]", joined(numbers, ", "));
  }

  const Document& document_;
  const SceneDesc& scene_;
  fs::path folder_;
  bool natural_textures_ = true;
  std::map<const Mesh*, std::string> mesh_keys_;
  std::set<const Mesh*> by_reference_;
  std::map<std::string, int> name_count_;
};

} // namespace

std::string candela_json(const Document& document, const std::string& folder) {
  if (auto problem = document_problem(document); !problem.empty())
    throw output_error("scene", problem, "correct it before writing");
  return CandelaWriter(document, folder).run();
}

void write_candela_json(const Document& document, const std::string& path) {
  write_file_atomically(path, candela_json(document, folder_of(path)));
}

} // namespace candela
