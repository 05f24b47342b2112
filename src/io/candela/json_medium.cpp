#include "io/candela/json_medium.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

namespace candela {

namespace {

PhaseDesc read_phase(JsonValue object, const std::string& element) {
  PhaseDesc phase;
  expect(object, JsonType::object, element);
  for (auto [key, value] : object.members()) // first, because the other keys depend on it
    if (key.string() == "type") {
      int type = 0;
      read_field(phase_type_field(), &type, value, element + ".type");
      phase = default_phase(type);
    }
  for (auto [key, value] : object.members())
    if (key.string() != "type" && !read_row(phase_fields(phase), phase, key, value, element))
      throw unknown_key(key, element, keys_of(phase_fields(phase), {"type"}));
  return phase;
}

/// The rows whose values are not those of `standard`.
template <class Owner>
std::vector<std::string> changed_members(std::span<const Field<Owner>> rows, const Owner& owner,
                                         const Owner& standard) {
  std::vector<std::string> members;
  for (const auto& row : rows) {
    const void* value = row.address(const_cast<Owner&>(owner));
    if (!field_equal(row, value, row.address(const_cast<Owner&>(standard))))
      members.push_back(fmt::format("\"{}\": {}", row.key, field_json(row, value)));
  }
  return members;
}

std::vector<std::string_view> known_keys(const MediumDesc& medium) {
  auto keys = keys_of(medium_fields(medium), {"name", "type", "phase"});
  if (takes_grid(medium)) keys.emplace_back("file");
  return keys;
}

std::string_view type_name(const FieldInfo& types, int type) {
  return types.choices[static_cast<std::size_t>(type)];
}

} // namespace

MediumDesc read_json_medium(JsonValue object, const std::string& element, SceneBuilder& builder,
                            const std::string& folder) {
  MediumDesc medium;
  for (auto [key, value] : object.members())
    if (key.string() == "type") {
      int type = 0;
      read_field(medium_type_field(), &type, value, element + ".type");
      medium = default_medium(type);
    }
  for (auto [key, value] : object.members()) {
    if (key.string() == "type") continue;
    if (key.string() == "name")
      medium.name = read_string(value, element + ".name");
    else if (key.string() == "phase")
      medium.phase = read_phase(value, element + ".phase");
    else if (key.string() == "file" && takes_grid(medium))
      set_medium_grid(medium,
                      builder.volume(builder.policy().require(read_string(value, element + ".file"), folder,
                                                              value.where(), element + ".file")));
    else if (!read_row(medium_fields(medium), medium, key, value, element))
      throw unknown_key(key, element, known_keys(medium));
  }
  return medium;
}

std::vector<std::string> json_medium_members(const MediumDesc& medium,
                                             const std::function<std::string(const std::string&)>& path_of) {
  std::vector<std::string> members = {fmt::format("\"name\": {}", json_quoted(medium.name))};
  const int type = medium_type(medium), phase = phase_type(medium.phase);
  if (type != 0)
    members.push_back(fmt::format("\"type\": {}", json_quoted(type_name(medium_type_field(), type))));
  if (const auto grid = medium_grid(medium); grid && !grid->source.empty())
    members.push_back(fmt::format("\"file\": {}", json_quoted(path_of(grid->source))));
  for (std::string& member : changed_members(medium_fields(medium), medium, default_medium(type)))
    members.push_back(std::move(member));
  std::vector<std::string> inner =
      changed_members(phase_fields(medium.phase), medium.phase, default_phase(phase));
  if (phase != 0)
    inner.insert(inner.begin(),
                 fmt::format("\"type\": {}", json_quoted(type_name(phase_type_field(), phase))));
  if (!inner.empty()) members.push_back(fmt::format("\"phase\": {{{}}}", fmt::join(inner, ", ")));
  return members;
}

} // namespace candela
