#include "io/candela/json_mesh.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

#include <optional>

namespace candela {

namespace {

constexpr int kMaxIndex = std::numeric_limits<int>::max();

/// Reads an array of arrays of N floats.
template <class Vec, int N>
std::vector<Vec> read_vectors(JsonValue value, std::string_view element, const WarningList& warnings) {
  expect(value, JsonType::array, element);
  std::vector<Vec> out;
  out.reserve(value.size());
  for (JsonValue part : value) {
    warnings.check_stop();
    float v[N];
    read_reals(part, std::span<float>(v), element);
    Vec vector;
    for (int i = 0; i < N; ++i) vector[i] = v[i];
    out.push_back(vector);
  }
  return out;
}

std::vector<vec3> read_colors(JsonValue value, std::string_view element, const WarningList& warnings) {
  auto colors = read_vectors<vec3, 3>(value, element, warnings);
  const auto negative =
      std::ranges::find_if(colors, [](vec3 c) { return !(glm::min(c.x, glm::min(c.y, c.z)) >= 0); });
  if (negative != colors.end())
    throw input_error(value.where(), element, fmt::format("colour {} is negative", negative - colors.begin()),
                      "give linear values of 0 or more");
  return colors;
}

std::vector<uvec3> read_triangles(JsonValue value, std::size_t vertices, std::string_view element,
                                  const WarningList& warnings) {
  expect(value, JsonType::array, element);
  std::vector<uvec3> out;
  out.reserve(value.size());
  int last = static_cast<int>(std::min<std::size_t>(vertices, kMaxIndex)) - 1;
  for (JsonValue part : value) {
    warnings.check_stop();
    expect(part, JsonType::array, element);
    if (part.size() != 3)
      throw input_error(part.where(), element, fmt::format("{} corners", part.size()), "give three indices");
    uvec3 triangle;
    int i = 0;
    for (JsonValue index : part)
      triangle[i++] = static_cast<std::uint32_t>(read_integer(index, element, 0, last));
    out.push_back(triangle);
  }
  return out;
}

void check_count(JsonValue value, std::size_t expected, std::string_view element, std::string_view of) {
  if (value.size() != expected)
    throw input_error(value.where(), element,
                      fmt::format("{} elements for {} {}", value.size(), expected, of),
                      fmt::format("give one for each of the {}", of));
}

/// Keeps unit and zero normals bit for bit; normalises others.
void make_unit(std::vector<vec3>& normals, const WarningList& warnings) {
  for (vec3& n : normals) {
    warnings.check_stop();
    double length = glm::length(glm::dvec3(n));
    if (length > 0 && std::abs(length - 1) > 1e-5) n = vec3(glm::dvec3(n) / length);
  }
}

} // namespace

Mesh read_json_mesh(JsonValue object, const std::string& name, std::string_view element,
                    const WarningList& warnings) {
  constexpr std::string_view kKeys[] = {
      "name",   "positions",     "triangles",   "normals",       "uvs",         "material_slots", "slots",
      "source", "vertex_colors", "face_colors", "positions_end", "normals_end", "source_end"};
  Mesh mesh;
  mesh.name = name;
  // Counts are checked after all members have been found.
  std::optional<JsonValue> triangles, normals, uvs, slots, vertex_colors, face_colors, positions_end,
      normals_end;
  for (auto [key, value] : object.members()) {
    std::string where = fmt::format("{}.{}", element, key.string());
    if (key.string() == "positions") {
      mesh.positions = read_vectors<vec3, 3>(value, where, warnings);
    } else if (key.string() == "positions_end") {
      positions_end = value;
      mesh.positions_end = read_vectors<vec3, 3>(value, where, warnings);
    } else if (key.string() == "normals_end") {
      normals_end = value;
      mesh.normals_end = read_vectors<vec3, 3>(value, where, warnings);
      make_unit(mesh.normals_end, warnings);
    } else if (key.string() == "triangles") {
      triangles = value;
    } else if (key.string() == "normals") {
      normals = value;
      mesh.normals = read_vectors<vec3, 3>(value, where, warnings);
      make_unit(mesh.normals, warnings);
    } else if (key.string() == "uvs") {
      uvs = value;
      mesh.uvs = read_vectors<vec2, 2>(value, where, warnings);
    } else if (key.string() == "vertex_colors") {
      vertex_colors = value;
      mesh.vertex_colors = read_colors(value, where, warnings);
    } else if (key.string() == "face_colors") {
      face_colors = value;
      mesh.face_colors = read_colors(value, where, warnings);
    } else if (key.string() == "material_slots") {
      slots = value;
    } else if (key.string() == "slots") {
      expect(value, JsonType::array, where);
      mesh.slot_names.clear();
      for (JsonValue slot : value) mesh.slot_names.push_back(read_string(slot, where));
      if (mesh.slot_names.empty())
        throw input_error(value.where(), where, "it is empty", "name one slot at least, or leave it out");
    } else if (key.string() == "source") {
      mesh.source = read_string(value, where);
    } else if (key.string() == "source_end") {
      mesh.source_end = read_string(value, where);
    } else if (key.string() != "name") {
      throw unknown_key(key, element, kKeys);
    }
  }
  if (!triangles || triangles->type() != JsonType::array || triangles->size() == 0)
    throw input_error((triangles ? *triangles : object).where(), element, "it has no triangles",
                      "give \"positions\" and \"triangles\", or a \"file\"");
  mesh.triangles =
      read_triangles(*triangles, mesh.positions.size(), fmt::format("{}.triangles", element), warnings);
  if (normals && !mesh.normals.empty())
    check_count(*normals, mesh.positions.size(), fmt::format("{}.normals", element), "positions");
  if (uvs && !mesh.uvs.empty())
    check_count(*uvs, mesh.positions.size(), fmt::format("{}.uvs", element), "positions");
  if (positions_end)
    check_count(*positions_end, mesh.positions.size(), fmt::format("{}.positions_end", element), "positions");
  if (normals_end && !positions_end)
    throw input_error(normals_end->where(), fmt::format("{}.normals_end", element),
                      "the mesh has no positions at time 1", "give \"positions_end\", too");
  if (positions_end && (normals_end ? mesh.normals_end.size() : 0) != mesh.normals.size())
    throw input_error(
        (normals_end ? *normals_end : *positions_end).where(), fmt::format("{}.normals_end", element),
        fmt::format("there are {} for {} normals", mesh.normals_end.size(), mesh.normals.size()),
        "give one for each of \"normals\", or leave both out");
  if (vertex_colors && !mesh.vertex_colors.empty())
    check_count(*vertex_colors, mesh.positions.size(), fmt::format("{}.vertex_colors", element), "positions");
  if (face_colors && !mesh.face_colors.empty())
    check_count(*face_colors, mesh.triangles.size(), fmt::format("{}.face_colors", element), "triangles");
  if (slots) {
    std::string where = fmt::format("{}.material_slots", element);
    expect(*slots, JsonType::array, where);
    int last = static_cast<int>(mesh.slot_names.size()) - 1;
    for (JsonValue slot : *slots) {
      warnings.check_stop();
      mesh.material_slots.push_back(static_cast<std::uint32_t>(read_integer(slot, where, 0, last)));
    }
    if (!mesh.material_slots.empty()) check_count(*slots, mesh.triangles.size(), where, "triangles");
  }
  return mesh;
}

namespace {

/// "key": [items], as many in a line as fit.
template <class Range, class ToText>
std::string array_member(std::string_view key, const Range& range, std::string_view indent, ToText to_text) {
  constexpr std::size_t kLineWidth = 100;
  std::string out = fmt::format("{}\"{}\": [", indent, key);
  std::size_t line_start = 0;
  bool first = true;
  for (const auto& item : range) {
    std::string text = to_text(item);
    if (!first) out += ',';
    if (out.size() - line_start + text.size() + 2 > kLineWidth) {
      out += fmt::format("\n{}  ", indent);
      line_start = out.size() - indent.size() - 2;
    } else if (!first) {
      out += ' ';
    }
    out += text;
    first = false;
  }
  return out + "]";
}

} // namespace

std::string json_mesh_members(const Mesh& mesh, std::string_view indent) {
  auto vec3_text = [](const vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); };
  std::string out = array_member("positions", mesh.positions, indent, vec3_text);
  auto add = [&](std::string member) { out += ",\n" + std::move(member); };
  if (!mesh.normals.empty()) add(array_member("normals", mesh.normals, indent, vec3_text));
  if (mesh.deforms()) add(array_member("positions_end", mesh.positions_end, indent, vec3_text));
  if (!mesh.normals_end.empty()) add(array_member("normals_end", mesh.normals_end, indent, vec3_text));
  if (!mesh.uvs.empty())
    add(array_member("uvs", mesh.uvs, indent,
                     [](const vec2& v) { return fmt::format("[{}, {}]", v.x, v.y); }));
  if (!mesh.vertex_colors.empty()) add(array_member("vertex_colors", mesh.vertex_colors, indent, vec3_text));
  if (!mesh.face_colors.empty()) add(array_member("face_colors", mesh.face_colors, indent, vec3_text));
  add(array_member("triangles", mesh.triangles, indent,
                   [](const uvec3& t) { return fmt::format("[{}, {}, {}]", t.x, t.y, t.z); }));
  if (!mesh.material_slots.empty())
    add(array_member("material_slots", mesh.material_slots, indent,
                     [](std::uint32_t slot) { return fmt::format("{}", slot); }));
  if (mesh.slot_names != std::vector<std::string>{""})
    add(array_member("slots", mesh.slot_names, indent, [](const std::string& s) { return json_quoted(s); }));
  if (!mesh.source.empty()) add(fmt::format("{}\"source\": {}", indent, json_quoted(mesh.source)));
  if (!mesh.source_end.empty())
    add(fmt::format("{}\"source_end\": {}", indent, json_quoted(mesh.source_end)));
  return out;
}

} // namespace candela
