#pragma once
// What the readers of a Candela JSON's lists share.

#include "io/builder/scene_builder.h"
#include "io/candela/json_fields.h"

#include <fmt/format.h>

#include <functional>
#include <string>

namespace candela {

/// The scene in the making, and the place of the file that is being read.
struct JsonSource {
  SceneBuilder& builder;
  std::string folder;                   ///< of the file, whose file names are relative to it
  std::function<void(JsonValue)> reach; ///< reports progress up to this value

  /// The file that the string names. Throws input_error at it.
  FoundFile require_file(JsonValue name, const std::string& element) const {
    return builder.policy().require(read_string(name, element), folder, name.where(), element);
  }

  /// Calls visit(object, element) for each element of an array of objects.
  template <class Visit>
  void each_object(JsonValue array, std::string_view element, Visit visit) const {
    expect(array, JsonType::array, element);
    int index = 0;
    for (JsonValue object : array) {
      reach(object);
      std::string name = fmt::format("{}[{}]", element, index++);
      expect(object, JsonType::object, name);
      visit(object, name);
    }
  }
};

/// The error of a name that no `what` ("mesh") has; `list` is where one would be defined.
inline Error missing_name(JsonValue value, std::string_view element, std::string_view what,
                          std::string_view list, std::span<const std::string_view> names) {
  const std::string& name = value.string();
  const std::string near = nearest_name(name, names);
  return input_error(value.where(), element, fmt::format("there is no {} '{}'", what, name.substr(0, 60)),
                     near.empty() ? fmt::format("define it in \"{}\"", list)
                                  : fmt::format("did you mean '{}'?", near));
}

} // namespace candela
