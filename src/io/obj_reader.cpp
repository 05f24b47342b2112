#include "io/obj_reader.h"

#include "core/hash.h"
#include "io/obj_lines.h"
#include "io/text_file.h"
#include "io/triangulate.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <filesystem>
#include <istream>

namespace candela {

namespace {

constexpr std::size_t kMaxObjBytes = 0x7fffffff;
/// Of the time that a file takes, that of its lines; the rest makes vertices and triangles of them.
constexpr double kLinesShare = 0.7;

/// One corner of a polygon: indices from 0, -1 where it has none.
struct Corner {
  int v, vt, vn;
  bool operator==(const Corner&) const = default;
};

/// Numbers corners in the order in which they come, equal ones alike. Open addressing with linear probing: a
/// large model has millions of corners, and a node for each would take more memory than the mesh.
class CornerNumbers {
public:
  /// The number, and whether it is a new one.
  std::pair<std::uint32_t, bool> number(const Corner& c) {
    if (2 * (corners_.size() + 1) > slots_.size()) grow();
    std::size_t at = slot_of(c);
    for (; slots_[at] != kFree; at = (at + 1) & (slots_.size() - 1))
      if (corners_[slots_[at]] == c) return {slots_[at], false};
    slots_[at] = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back(c);
    return {slots_[at], true};
  }

private:
  static constexpr std::uint32_t kFree = 0xffffffffu;

  std::size_t slot_of(const Corner& c) const {
    auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    return hash_combine(hash64(bits(c.v) << 32 | bits(c.vt)), bits(c.vn)) & (slots_.size() - 1);
  }

  void grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), kFree);
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      std::size_t at = slot_of(corners_[i]);
      while (slots_[at] != kFree) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = i;
    }
  }

  std::vector<Corner> corners_;
  std::vector<std::uint32_t> slots_; ///< a power of two of them, at most half of them taken
};

struct Face {
  std::uint32_t first; ///< in the array of corners, which kMaxObjBytes keeps in range
  int count;
  std::uint32_t slot;
  int line;
};

/// What tinyobj's callbacks fill.
struct ObjContents {
  std::vector<vec3> positions, normals;
  std::vector<vec2> uvs;
  std::vector<Corner> corners;
  std::vector<Face> faces;
  std::vector<std::string> slot_names; ///< in UTF-8
  std::map<std::string, std::uint32_t, std::less<>> slots;
  std::string material; ///< the current one's name, as in the file
  std::vector<std::string> slot_materials;
  const ObjLines* lines = nullptr;

  std::uint32_t current_slot() {
    auto [known, is_new] =
        slots.try_emplace(utf8_name(material), static_cast<std::uint32_t>(slot_names.size()));
    if (is_new) slot_names.push_back(known->first), slot_materials.push_back(material);
    return known->second;
  }
};

int resolved(int index, std::size_t count) {
  return index > 0 ? index - 1 : index < 0 ? static_cast<int>(count) + index : -1;
}

/// tinyobj turns some curious spellings of finite numbers ("0e999") into NaN.
vec3 finite(const ObjContents& contents, vec3 v) {
  if (is_finite(v)) return v;
  throw input_error({contents.lines->file(), contents.lines->line()}, "number", "its spelling is too extreme",
                    "write it with fewer digits or a smaller exponent");
}

tinyobj::callback_t callbacks() {
  tinyobj::callback_t out;
  out.vertex_cb = [](void* p, float x, float y, float z, float) {
    auto& c = *static_cast<ObjContents*>(p);
    c.positions.push_back(finite(c, {x, y, z}));
  };
  out.normal_cb = [](void* p, float x, float y, float z) {
    auto& c = *static_cast<ObjContents*>(p);
    c.normals.push_back(finite(c, {x, y, z}));
  };
  out.texcoord_cb = [](void* p, float u, float v, float) {
    auto& c = *static_cast<ObjContents*>(p);
    c.uvs.emplace_back(finite(c, {u, v, 0}));
  };
  out.index_cb = [](void* p, tinyobj::index_t* indices, int count) {
    auto& c = *static_cast<ObjContents*>(p);
    c.faces.push_back(
        {static_cast<std::uint32_t>(c.corners.size()), count, c.current_slot(), c.lines->line()});
    for (const tinyobj::index_t& i : std::span(indices, static_cast<std::size_t>(count)))
      c.corners.push_back({resolved(i.vertex_index, c.positions.size()),
                           resolved(i.texcoord_index, c.uvs.size()),
                           resolved(i.normal_index, c.normals.size())});
  };
  return out;
}

/// Unifies corners into vertices of the mesh.
class MeshAssembly {
public:
  MeshAssembly(const ObjContents& contents, const std::string& file, WarningList& warnings,
               ProgressPart& progress)
      : c_(contents), file_(file), warnings_(warnings), progress_(progress) {
    for (const Corner& corner : c_.corners) has_normals_ |= corner.vn >= 0, has_uvs_ |= corner.vt >= 0;
  }

  Mesh run() {
    std::vector<vec3> outline;
    std::vector<std::array<int, 3>> triangles;
    const double share_of_face = (1 - kLinesShare) / static_cast<double>(c_.faces.size());
    double share = kLinesShare;
    for (const Face& face : c_.faces) {
      progress_.reach(share += share_of_face);
      std::span<const Corner> corners(c_.corners.data() + face.first, static_cast<std::size_t>(face.count));
      outline.clear();
      for (const Corner& corner : corners) outline.push_back(position(corner));
      triangles.clear();
      triangulate(outline, triangles);
      for (const auto& [a, b, c] : triangles) add(face, corners, outline, a, b, c);
    }
    return std::move(mesh_);
  }

private:
  vec3 position(const Corner& c) const { return c_.positions[static_cast<std::size_t>(c.v)]; }

  void add(const Face& face, std::span<const Corner> corners, std::span<const vec3> outline, int ia, int ib,
           int ic) {
    auto a = static_cast<std::size_t>(ia), b = static_cast<std::size_t>(ib), c = static_cast<std::size_t>(ic);
    glm::dvec3 origin(outline[a]);
    glm::dvec3 twice_area = glm::cross(glm::dvec3(outline[b]) - origin, glm::dvec3(outline[c]) - origin);
    if (twice_area == glm::dvec3(0)) {
      warnings_.add({file_, face.line, 0}, "triangles without area are dropped");
      return;
    }
    // Braces: the order in which vertices are numbered must not depend on the compiler.
    mesh_.triangles.push_back(uvec3{vertex(corners[a]), vertex(corners[b]), vertex(corners[c])});
    mesh_.material_slots.push_back(face.slot);
  }

  std::uint32_t vertex(const Corner& c) {
    auto [index, is_new] = vertices_.number(c);
    if (is_new) {
      mesh_.positions.push_back(position(c));
      if (has_normals_) {
        vec3 n = c.vn >= 0 ? c_.normals[static_cast<std::size_t>(c.vn)] : vec3(0);
        double length = glm::length(glm::dvec3(n)); // the square of a float could overflow
        mesh_.normals.push_back(length > 0 ? vec3(glm::dvec3(n) / length) : vec3(0));
      }
      if (has_uvs_) mesh_.uvs.push_back(c.vt >= 0 ? c_.uvs[static_cast<std::size_t>(c.vt)] : vec2(0));
    }
    return index;
  }

  const ObjContents& c_;
  const std::string& file_;
  WarningList& warnings_;
  ProgressPart& progress_;
  bool has_normals_ = false, has_uvs_ = false;
  CornerNumbers vertices_;
  Mesh mesh_;
};

/// "mtllib a b.mtl" is one name with a space or two names: the specification means two, exporters mean one.
void read_libraries(std::string_view names, const Location& where, const FoundFile& obj,
                    const PathPolicy& policy, MtlDialect dialect, WarningList& warnings,
                    MtlLibrary& library) {
  std::string folder = folder_of(obj.shown);
  if (names.empty()) return warnings.add(where, "mtllib names no file");
  auto try_read = [&](std::string_view name) {
    auto file = policy.find(std::string(name), folder, where, "mtllib");
    if (file) read_mtl(*file, policy, dialect, warnings, library);
    return file.has_value();
  };
  if (try_read(names)) return;
  bool several = names.find_first_of(" \t") != std::string_view::npos;
  do {
    std::string_view name = several ? names.substr(0, names.find_first_of(" \t")) : names;
    if (!several || !try_read(name))
      warnings.add(where, fmt::format("the material library '{}' is missing", name.substr(0, 200)));
    names = trimmed(names.substr(name.size()));
  } while (!names.empty());
}

} // namespace

ObjModel read_obj(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect,
                  WarningList& warnings) {
  std::string text = read_text_file(file.canonical, "mesh", kMaxObjBytes);
  ObjContents contents;
  MtlLibrary library;
  ProgressPart progress = warnings.part(file.canonical, text.size());
  ObjLines lines(file.shown, text, warnings, progress, kLinesShare);
  contents.lines = &lines;
  lines.on_usemtl = [&](std::string_view name, const Location&) { contents.material = name; };
  lines.on_mtllib = [&](std::string_view names, const Location& where) {
    read_libraries(names, where, file, policy, dialect, warnings, library);
  };
  std::istream stream(&lines);
  stream.exceptions(std::ios::badbit); // lets the errors of ObjLines through
  tinyobj::LoadObjWithCallback(stream, callbacks(), &contents, nullptr, nullptr, nullptr);
  lines.check_forward_indices();
  std::string().swap(text); // the largest of all that is in memory here

  ObjModel model;
  model.mesh = MeshAssembly(contents, file.shown, warnings, progress).run();
  Mesh& mesh = model.mesh;
  if (mesh.triangles.empty())
    throw input_error({file.shown}, "mesh", "it has no face", "export the model with faces");
  mesh.name = utf8_name(std::filesystem::path(file.shown).stem().string());
  mesh.source = file.canonical;
  mesh.slot_names = contents.slot_names;
  if (mesh.slot_names.size() == 1) mesh.material_slots.clear();
  for (const std::string& name : contents.slot_materials) {
    auto known = library.find(name);
    model.materials.push_back(known == library.end() ? std::nullopt : std::optional(known->second));
  }
  return model;
}

} // namespace candela
