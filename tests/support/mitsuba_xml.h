#pragma once
// Values in Mitsuba's XML.

#include "core/math.h"

#include <pugixml.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace candela::test::mitsuba_xml {

using Node = pugi::xml_node;

inline std::runtime_error unknown(const char* what, const Node& node) {
  std::ostringstream out;
  node.print(out, "", pugi::format_raw);
  return std::runtime_error(std::string("unknown ") + what + ": " + out.str().substr(0, 200));
}

/// The numbers of "1, 2 3".
inline std::vector<float> numbers(std::string text) {
  std::ranges::replace(text, ',', ' ');
  std::istringstream in(text);
  std::vector<float> values;
  for (float v = 0; in >> v;) values.push_back(v);
  if (!in.eof()) throw std::runtime_error("no numbers: " + text);
  return values;
}
inline vec3 three(const std::string& text) {
  const std::vector<float> v = numbers(text);
  if (v.size() == 1) return vec3(v[0]);
  if (v.size() != 3) throw std::runtime_error("not three numbers: " + text);
  return {v[0], v[1], v[2]};
}

inline Node child(const Node& node, std::string_view name) {
  for (Node c : node.children())
    if (name == c.attribute("name").value()) return c;
  return {};
}
inline std::string text(const Node& node, std::string_view name, std::string otherwise) {
  const Node c = child(node, name);
  return c ? c.attribute("value").value() : otherwise;
}
inline float number(const Node& node, std::string_view name, float otherwise) {
  const Node c = child(node, name);
  return c ? c.attribute("value").as_float() : otherwise;
}

/// The value or, of two attributes x, y, z that differ from the rest, those.
inline vec3 axes(const Node& node, float otherwise) {
  if (node.attribute("value")) return three(node.attribute("value").value());
  return {node.attribute("x").as_float(otherwise), node.attribute("y").as_float(otherwise),
          node.attribute("z").as_float(otherwise)};
}

inline mat4 transform(const Node& parent, const char* name = "to_world") {
  mat4 m(1);
  for (const Node& step : child(parent, name).children()) {
    const std::string_view kind = step.name();
    if (kind == "translate")
      m = glm::translate(mat4(1), axes(step, 0)) * m;
    else if (kind == "scale")
      m = glm::scale(mat4(1), axes(step, 1)) * m;
    else if (kind == "rotate")
      m = glm::rotate(mat4(1), radians(step.attribute("angle").as_float()), axes(step, 0)) * m;
    else if (kind == "matrix") {
      const std::vector<float> rows = numbers(step.attribute("value").value());
      mat4 matrix;
      for (int i = 0; i < 16; ++i) matrix[i % 4][i / 4] = rows.at(static_cast<std::size_t>(i));
      m = matrix * m;
    } else
      throw unknown("transform", step);
  }
  return m;
}

} // namespace candela::test::mitsuba_xml
