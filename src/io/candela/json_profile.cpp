#include "io/candela/json_profile.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

#include <array>

namespace candela {

namespace {

constexpr std::array<std::string_view, 3> kTypes = {"c", "a", "b"}; ///< by PhotometricType

std::vector<float> numbers(JsonValue array, const std::string& element) {
  expect(array, JsonType::array, element);
  std::vector<float> out;
  out.reserve(array.size());
  for (JsonValue value : array) out.push_back(read_real(value, element));
  return out;
}

} // namespace

std::shared_ptr<const IesProfile> read_json_profile(JsonValue object, const std::string& element) {
  constexpr std::string_view kKeys[] = {"name", "type", "vertical", "horizontal", "candela"};
  auto profile = std::make_shared<IesProfile>();
  for (auto [key, value] : object.members()) {
    const std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "name") {
      profile->name = read_string(value, name);
    } else if (key.string() == "type") {
      const auto known = std::ranges::find(kTypes, read_string(value, name));
      if (known == kTypes.end())
        throw input_error(value.where(), name, "there is no such photometric type", "give a, b or c");
      profile->type = static_cast<PhotometricType>(known - kTypes.begin());
    } else if (key.string() == "vertical") {
      profile->vertical = numbers(value, name);
      for (float& angle : profile->vertical) angle = radians(angle);
    } else if (key.string() == "horizontal") {
      profile->horizontal = numbers(value, name);
      for (float& angle : profile->horizontal) angle = radians(angle);
    } else if (key.string() == "candela") {
      profile->candela = numbers(value, name);
    } else {
      throw unknown_key(key, element, kKeys);
    }
  }
  if (const std::string problem = ies_profile_problem(*profile); !problem.empty())
    throw input_error(object.where(), element, problem, "give angles that ascend, and a value for each pair");
  return profile;
}

std::string json_profile(const IesProfile& profile) {
  auto degrees_of = [](const std::vector<float>& angles) {
    std::vector<double> out;
    for (float angle : angles) out.push_back(static_cast<double>(angle) * 180 / std::numbers::pi);
    return out;
  };
  return fmt::format(
      "{{\"name\": {}, \"type\": \"{}\", \"vertical\": [{}], \"horizontal\": [{}], \"candela\": [{}]}}",
      json_quoted(profile.name), kTypes[static_cast<std::size_t>(profile.type)],
      fmt::join(degrees_of(profile.vertical), ","), fmt::join(degrees_of(profile.horizontal), ","),
      fmt::join(profile.candela, ","));
}

} // namespace candela
