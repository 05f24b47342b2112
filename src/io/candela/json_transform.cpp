#include "io/candela/json_transform.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

namespace candela {

namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

dmat4 read_matrix(JsonValue value, std::string_view element) {
  double rows[16];
  read_reals(value, std::span<double>(rows), element);
  dmat4 m;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) m[c][r] = rows[4 * r + c];
  return m;
}

dmat4 read_rotate(JsonValue value, std::string_view element) {
  float v[4];
  read_reals(value, std::span<float>(v), element);
  dvec3 axis(v[0], v[1], v[2]);
  if (axis == dvec3(0))
    throw input_error(value.where(), element, "the axis has no length", "give [axis x, y, z, degrees]");
  return rotation(axis, static_cast<double>(v[3]));
}

dmat4 read_scale(JsonValue value, std::string_view element) {
  vec3 s = value.type() == JsonType::number ? vec3(read_real(value, element)) : read_vec3(value, element);
  return glm::scale(dmat4(1), dvec3(s));
}

dmat4 read_look_at(JsonValue value, std::string_view element) {
  constexpr std::string_view kKeys[] = {"origin", "target", "up"};
  expect(value, JsonType::object, element);
  dvec3 origin(0), target(0, 0, 1), up(0, 1, 0);
  for (auto [key, part] : value.members()) {
    std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "origin")
      origin = dvec3(read_vec3(part, name));
    else if (key.string() == "target")
      target = dvec3(read_vec3(part, name));
    else if (key.string() == "up")
      up = dvec3(read_vec3(part, name));
    else
      throw unknown_key(key, element, kKeys);
  }
  dvec3 z = target - origin, x = glm::cross(up, z);
  if (x == dvec3(0))
    throw input_error(value.where(), element, "up is parallel to the view, or target is the origin",
                      "give another up or target");
  z = glm::normalize(z), x = glm::normalize(x);
  return {dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(origin, 1)};
}

dmat4 read_step(JsonValue step, std::string_view element) {
  constexpr std::string_view kKeys[] = {"translate", "rotate", "scale", "matrix", "look_at"};
  expect(step, JsonType::object, element);
  if (step.size() != 1)
    throw input_error(step.where(), element, fmt::format("{} keys", step.size()),
                      "give one of translate, rotate, scale, matrix, look_at");
  auto [key, value] = step.members().front();
  std::string name = fmt::format("{}.{}", element, key.string());
  if (key.string() == "translate") {
    double v[3];
    read_reals(value, std::span<double>(v), name);
    return glm::translate(dmat4(1), dvec3(v[0], v[1], v[2]));
  }
  if (key.string() == "rotate") return read_rotate(value, name);
  if (key.string() == "scale") return read_scale(value, name);
  if (key.string() == "matrix") return read_matrix(value, name);
  if (key.string() == "look_at") return read_look_at(value, name);
  throw unknown_key(key, element, kKeys);
}

} // namespace

dmat4 rotation(dvec3 axis, double degrees) {
  double turn = std::remainder(degrees, 360.0);
  double s = std::sin(turn * (std::numbers::pi / 180)), c = std::cos(turn * (std::numbers::pi / 180));
  if (std::remainder(turn, 90.0) == 0) s = std::round(s), c = std::round(c);
  // Rodrigues' formula.
  dvec3 a = glm::normalize(axis);
  dmat4 m(1);
  m[0] = dvec4(c + a.x * a.x * (1 - c), a.x * a.y * (1 - c) + a.z * s, a.x * a.z * (1 - c) - a.y * s, 0);
  m[1] = dvec4(a.x * a.y * (1 - c) - a.z * s, c + a.y * a.y * (1 - c), a.y * a.z * (1 - c) + a.x * s, 0);
  m[2] = dvec4(a.x * a.z * (1 - c) + a.y * s, a.y * a.z * (1 - c) - a.x * s, c + a.z * a.z * (1 - c), 0);
  return m;
}

std::string_view transform_problem(const dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(static_cast<float>(m[c][r]))) return "it is not finite";
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
    return "it is not affine: its last row is not 0 0 0 1";
  double determinant = glm::determinant(glm::dmat3(m));
  if (determinant == 0 || !std::isfinite(determinant)) return "it flattens the object (no inverse)";
  return {};
}

dmat4 read_transform(JsonValue value, std::string_view element) {
  expect(value, JsonType::array, element);
  dmat4 m(1);
  if (value.size() > 0 && (*value.begin()).type() == JsonType::number) {
    m = read_matrix(value, element);
  } else {
    int index = 0;
    for (JsonValue step : value) m = read_step(step, fmt::format("{}[{}]", element, index++)) * m;
  }
  if (auto problem = transform_problem(m); !problem.empty())
    throw input_error(value.where(), element, problem, "give an affine transform with an inverse");
  return m;
}

} // namespace candela
