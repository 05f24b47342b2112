#include "io/obj/obj_reader.h"

#include "io/files/text_file.h"
#include "io/files/text_lines.h"
#include "io/obj/obj_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace candela {

namespace {

constexpr std::size_t kMaxObjBytes = 0x7fffffff;
/// Share of the reading time that parsing lines takes; the rest converts them to vertices and triangles.
constexpr double kObjLinesShare = 0.7;

/// The material libraries that an OBJ names.
class Libraries {
public:
  Libraries(const FoundFile& obj, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings)
      : obj_(obj), policy_(policy), dialect_(dialect), warnings_(warnings) {}

  /// "mtllib a b.mtl" is two names according to the specification, but exporters write one name with a space.
  void read(std::string_view names, const Location& where) {
    if (names.empty()) return warnings_.add(where, "mtllib names no file");
    if (try_read(names, where)) return;
    bool several = names.find_first_of(" \t") != std::string_view::npos;
    do {
      std::string_view name = several ? names.substr(0, names.find_first_of(" \t")) : names;
      if (!several || !try_read(name, where)) {
        warnings_.add(where,
                      fmt::format("the material library '{}' is missing", utf8_name(name.substr(0, 200))));
        where_missing_ = where;
      }
      names = trimmed(names.substr(name.size()));
    } while (!names.empty());
  }

  /// Called after all of them: if one is missing, or none was named, the library with the OBJ's name is used.
  void read_namesake() {
    const std::string name = std::filesystem::path(obj_.shown).stem().string() + ".mtl";
    const Location where = where_missing_.value_or(Location{obj_.shown});
    if (read_.contains(name) || !try_read(name, where)) return;
    warnings_.add(where,
                  fmt::format("the material library of the mesh's own name is taken: '{}'", utf8_name(name)));
  }

  bool is_missing() const { return where_missing_.has_value() || read_.empty(); }
  MtlLibrary library;

private:
  bool try_read(std::string_view name, const Location& where) {
    auto file = policy_.find_exported(std::string(name), folder_of(obj_.shown), where, "mtllib", warnings_);
    if (!file) return false;
    read_.insert(std::filesystem::path(file->shown).filename().string());
    read_mtl(*file, policy_, dialect_, warnings_, library);
    return true;
  }

  const FoundFile& obj_;
  const PathPolicy& policy_;
  MtlDialect dialect_;
  WarningList& warnings_;
  std::set<std::string> read_; ///< without folders
  std::optional<Location> where_missing_;
};

} // namespace

ObjModel read_obj(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect,
                  WarningList& warnings) {
  std::string text = read_text_file(file.canonical, "mesh", kMaxObjBytes, &warnings);
  Libraries libraries(file, policy, dialect, warnings);
  ProgressPart progress = warnings.part(file.canonical, text.size());
  ObjParser parser(file.shown, warnings);
  parser.on_mtllib = [&](std::string_view names, const Location& where) { libraries.read(names, where); };
  TextLines lines(text, progress, kObjLinesShare);
  while (lines.next()) parser.line(lines.line(), lines.number());
  std::string().swap(text); // the largest allocation here
  ObjContents& contents = parser.contents;
  auto is_unknown = [&](const std::string& name) {
    return !name.empty() && !libraries.library.contains(name);
  };
  if (libraries.is_missing() && std::ranges::any_of(contents.slot_materials, is_unknown))
    libraries.read_namesake();

  ObjModel model;
  model.mesh = obj_mesh(contents, file.shown, warnings, progress, kObjLinesShare);
  Mesh& mesh = model.mesh;
  mesh.name = utf8_name(std::filesystem::path(file.shown).stem().string());
  mesh.source = file.canonical;
  mesh.slot_names = contents.slot_names;
  if (mesh.slot_names.size() == 1) mesh.material_slots.clear();
  for (const std::string& name : contents.slot_materials) {
    auto known = libraries.library.find(name);
    model.materials.push_back(known == libraries.library.end() ? std::nullopt : std::optional(known->second));
  }
  return model;
}

} // namespace candela
