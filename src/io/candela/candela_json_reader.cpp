#include "io/candela/candela_json.h"
#include "io/candela/json_camera.h"
#include "io/candela/json_instance_list.h"
#include "io/candela/json_light.h"
#include "io/candela/json_medium.h"
#include "io/files/text_file.h"

#include <algorithm>

namespace candela {

namespace {

constexpr std::size_t kMaxJsonBytes = std::size_t{512} << 20;

class CandelaReader {
public:
  CandelaReader(std::string text, const FoundFile& file, const PathPolicy& policy, WarningList& warnings)
      : progress_(warnings.part(file.canonical, text.size())),
        tree_(file.shown, std::move(text), &progress_, kTreeShare),
        builder_(document_.scene, policy, MtlDialect::standard, warnings), source_{builder_,
                                                                                   folder_of(file.shown),
                                                                                   [this](JsonValue value) {
                                                                                     reach(value);
                                                                                   }} {}
  CandelaReader(const CandelaReader&) = delete; // the members refer to each other
  CandelaReader& operator=(const CandelaReader&) = delete;

  Document run() {
    constexpr std::string_view kKeys[] = {"candela", "description", "camera",  "bookmarks",    "media",
                                          "medium",  "materials",   "lights",  "light_groups", "textures",
                                          "meshes",  "instances",   "settings"};
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
    // In this order, whatever that of the file: later members refer to entries of earlier ones.
    auto read = [&](const char* key, auto reader) {
      if (auto it = parts.find(key); it != parts.end()) reader(it->second);
    };
    SceneDesc& scene = document_.scene;
    read("settings", [&](JsonValue object) { settings_below(object, "settings", ""); });
    read("camera", [&](JsonValue object) { scene.camera = read_json_camera(object, "camera"); });
    read("bookmarks", [&](JsonValue array) { scene.bookmarks = read_json_bookmarks(array); });
    read("media", [&](JsonValue array) { read_media(array); });
    read("medium", [&](JsonValue name) {
      scene.medium = read_string(name, "medium");
      check_medium(name, "medium", scene.medium);
    });
    read("textures", [&](JsonValue array) { materials_.read_textures(array); });
    read("materials", [&](JsonValue array) { materials_.read_materials(array); });
    read("lights", [&](JsonValue array) {
      source_.each_object(array, "lights", [&](JsonValue object, const std::string& element) {
        scene.lights.push_back(read_json_light(object, element, builder_, source_.folder));
      });
    });
    read("light_groups", [&](JsonValue array) {
      source_.each_object(array, "light_groups", [&](JsonValue object, const std::string& element) {
        scene.light_groups.push_back(read_json_light_group(object, element));
      });
      if (const std::string problem = light_groups_problem(scene); !problem.empty())
        throw input_error(array.where(), "light_groups", problem.substr(0, problem.find("; ")),
                          problem.substr(problem.find("; ") + 2));
    });
    read("meshes", [&](JsonValue object) { instances_.read_meshes(object); });
    read("instances", [&](JsonValue array) { instances_.read_instances(array); });
    return std::move(document_);
  }

private:
  void read_media(JsonValue array) {
    std::vector<MediumDesc>& media = document_.scene.media;
    source_.each_object(array, "media", [&](JsonValue object, const std::string& element) {
      media.push_back(read_json_medium(object, element, builder_, source_.folder));
      if (const std::string problem = media_problem(media); !problem.empty())
        throw input_error(object.where(), element, problem.substr(0, problem.find("; ")),
                          problem.substr(problem.find("; ") + 2));
    });
  }

  void check_medium(JsonValue at, const std::string& element, const std::string& name) const {
    if (const std::string problem = medium_name_problem(document_.scene, name); !problem.empty())
      throw input_error(at.where(), element, problem.substr(0, problem.find("; ")),
                        problem.substr(problem.find("; ") + 2));
  }

  /// Finds the files that will be read, so that progress is of all of them.
  void expect_files(JsonValue value) {
    progress_.check();
    auto expect_named = [&](JsonValue name) {
      if (name.type() == JsonType::string) builder_.expect_file(name.string(), source_.folder);
    };
    if (value.type() == JsonType::object) {
      for (auto [key, part] : value.members()) {
        if (key.string() == "file" || key.string() == "file_end" || key.string() == "profile" ||
            key.string() == "texture" || key.string() == "diffuse_texture")
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

  /// Reports progress up to a value: called for each element of long lists.
  void reach(JsonValue value) {
    progress_.reach(kTreeShare + (1 - kTreeShare) * static_cast<double>(value.offset()) /
                                     static_cast<double>(tree_.size()));
  }

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

  /// Share of the reading time that parsing takes.
  static constexpr double kTreeShare = 0.7;

  ProgressPart progress_;
  JsonTree tree_;
  Document document_;
  SceneBuilder builder_;
  JsonSource source_;
  JsonMaterialList materials_{source_};
  JsonInstanceList instances_{source_, materials_};
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
