#include "io/candela/json_camera.h"

#include "io/candela/json_fields.h"
#include "scene/document.h"

#include <fmt/format.h>

#include <set>

namespace candela {

namespace {

constexpr std::string_view kPrefix = "camera.";

} // namespace

Camera read_json_camera(JsonValue object, const std::string& element) {
  expect(object, JsonType::object, element);
  std::vector<std::string_view> known;
  for (const auto& row : settings_table())
    if (row.key.starts_with(kPrefix)) known.push_back(row.key.substr(kPrefix.size()));
  Document document;
  for (auto [key, value] : object.members()) {
    const auto* row = find_setting(std::string(kPrefix) + key.string());
    if (row == nullptr) throw unknown_key(key, element, known);
    read_field(*row, row->address(document), value, fmt::format("{}.{}", element, key.string()));
  }
  const Camera& c = document.scene.camera;
  if (c.position == c.target)
    throw input_error(object.where(), element, "position and target are the same", "move one of them");
  if (glm::cross(glm::dvec3(c.target) - glm::dvec3(c.position), glm::dvec3(c.up)) == glm::dvec3(0))
    throw input_error(object.where(), element, "up is parallel to the view", "give another up");
  if (const std::string problem = camera_motion_problem(c); !problem.empty()) {
    const std::size_t key = problem.find(": "), remedy = problem.find("; ");
    throw input_error(object.where(), fmt::format("{}.{}", element, problem.substr(0, key)),
                      problem.substr(key + 2, remedy - key - 2), problem.substr(remedy + 2));
  }
  return c;
}

std::vector<Bookmark> read_json_bookmarks(JsonValue array) {
  expect(array, JsonType::array, "bookmarks");
  if (array.size() > kMaxBookmarks)
    throw limit_error(array.where(), "bookmarks", fmt::format("there are {}", array.size()),
                      fmt::format("keep at most {}", kMaxBookmarks));
  constexpr std::string_view kKeys[] = {"name", "camera"};
  std::vector<Bookmark> out;
  std::set<std::string> names;
  for (JsonValue object : array) {
    const std::string element = fmt::format("bookmarks[{}]", out.size());
    expect(object, JsonType::object, element);
    Bookmark bookmark;
    for (auto [key, value] : object.members()) {
      const std::string part = fmt::format("{}.{}", element, key.string());
      if (key.string() == "name") {
        bookmark.name = read_string(value, part);
        if (bookmark.name.empty()) throw input_error(value.where(), part, "it is empty", "give a name");
        if (!names.insert(bookmark.name).second)
          throw input_error(value.where(), part, fmt::format("there is another bookmark '{}'", bookmark.name),
                            "give another name");
      } else if (key.string() == "camera") {
        bookmark.camera = read_json_camera(value, part);
      } else {
        throw unknown_key(key, element, kKeys);
      }
    }
    if (bookmark.name.empty())
      throw input_error(object.where(), element, "the key \"name\" is missing", "give a name");
    out.push_back(std::move(bookmark));
  }
  return out;
}

std::vector<std::string> json_camera_members(const Camera& camera) {
  Document document;
  document.scene.camera = camera;
  Document standard;
  std::vector<std::string> out;
  for (const auto& row : settings_table()) {
    if (!row.key.starts_with(kPrefix) || field_equal(row, row.address(document), row.address(standard)))
      continue;
    out.push_back(
        fmt::format("\"{}\": {}", row.key.substr(kPrefix.size()), field_json(row, row.address(document))));
  }
  return out;
}

std::vector<std::string> json_bookmarks(const std::vector<Bookmark>& bookmarks) {
  std::vector<std::string> out;
  for (const Bookmark& bookmark : bookmarks)
    out.push_back(fmt::format("{{\"name\": {}, \"camera\": {{{}}}}}", json_quoted(bookmark.name),
                              fmt::join(json_camera_members(bookmark.camera), ", ")));
  return out;
}

} // namespace candela
