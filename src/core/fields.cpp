#include "core/fields.h"

#include "core/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <vector>

namespace candela {

namespace {

template <class T>
const T& as(const void* address) {
  return *static_cast<const T*>(address);
}

/// A choice is an enum with underlying type int: its bytes are an int's, its type for aliasing is not.
int load_choice(const void* address) {
  int value = 0;
  std::memcpy(&value, address, sizeof value);
  return value;
}

float angle_value(double deg) { return static_cast<float>(deg * (std::numbers::pi / 180.0)); }

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> out;
  std::size_t i = 0;
  auto separates = [](char c) { return c == ' ' || c == ',' || c == '\t'; };
  while (i < text.size()) {
    while (i < text.size() && separates(text[i])) ++i;
    std::size_t begin = i;
    while (i < text.size() && !separates(text[i])) ++i;
    if (i > begin) out.push_back(text.substr(begin, i - begin));
  }
  return out;
}

template <class T>
bool parse_number(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  return status == std::errc() && end == word.data() + word.size();
}

Error bad_value(const FieldInfo& field, std::string_view text) {
  return usage_error(field.key, fmt::format("'{}' does not fit", text),
                     fmt::format("give {}", field_domain(field)));
}

/// Degrees that read back to the same float of radians, as short as may be: "45" for the float nearest to
/// pi/4. A float of degrees would not do: they can lie farther apart than those of radians.
std::string angle_text(float radians_value) {
  double deg = static_cast<double>(radians_value) * (180.0 / std::numbers::pi);
  std::string text;
  for (int digits = 6; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", deg, digits);
    double read = 0;
    if (parse_number(text, read) && angle_value(read) == radians_value) break;
  }
  return text;
}

bool is_int(FieldType type) { return type == FieldType::integer || type == FieldType::material; }

bool in_range(const FieldInfo& field, double value) {
  // Infinity passes only where the table leaves that side open. Reals are compared as the floats that they
  // become: 0.1 must pass a limit of 0.1, though in float it is a little more.
  auto stored = [&](double x) { return is_int(field.type) ? x : static_cast<double>(static_cast<float>(x)); };
  return (field.above_minimum ? stored(value) > stored(field.minimum)
                              : stored(value) >= stored(field.minimum)) &&
         stored(value) <= stored(field.maximum);
}

/// A limit as people write it: 1e9 rather than 1000000000, whose zeros are hard to count. Integers do not
/// take that form.
std::string bound_text(double bound, bool integer) {
  if (!integer && std::abs(bound) >= 1e6) {
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(bound))));
    std::string text = fmt::format("{}e{}", bound / std::pow(10, exponent), exponent);
    if (double read = 0; text.size() <= 8 && parse_number(text, read) && read == bound) return text;
  }
  return fmt::format("{}", bound);
}

void read_vector(const FieldInfo& field, vec3& out, std::string_view text) {
  auto parts = words(text);
  if (parts.size() != 1 && parts.size() != 3) throw bad_value(field, text);
  vec3 v;
  for (int i = 0; i < 3; ++i)
    if (!parse_number(parts[parts.size() == 1 ? 0 : static_cast<std::size_t>(i)], v[i]))
      throw bad_value(field, text);
  out = v;
}

} // namespace

std::string field_to_text(const FieldInfo& field, const void* address) {
  switch (field.type) {
  case FieldType::boolean: return as<bool>(address) ? "true" : "false";
  case FieldType::integer: return fmt::format("{}", as<int>(address));
  case FieldType::real: return fmt::format("{}", as<float>(address));
  case FieldType::angle: return angle_text(as<float>(address));
  case FieldType::choice: return std::string(field.choices[static_cast<std::size_t>(load_choice(address))]);
  case FieldType::material: return as<int>(address) < 0 ? "none" : fmt::format("{}", as<int>(address));
  case FieldType::point:
  case FieldType::color: {
    const vec3& v = as<vec3>(address);
    return fmt::format("{} {} {}", v.x, v.y, v.z);
  }
  }
  return {};
}

void field_from_text(const FieldInfo& field, void* address, std::string_view text) {
  auto assign = [&]<class T>(T value) {
    T old = as<T>(address);
    *static_cast<T*>(address) = value;
    if (field_problem(field, address).empty()) return;
    *static_cast<T*>(address) = old;
    throw bad_value(field, text);
  };
  switch (field.type) {
  case FieldType::boolean:
    if (text == "true" || text == "on" || text == "1")
      assign(true);
    else if (text == "false" || text == "off" || text == "0")
      assign(false);
    else
      throw bad_value(field, text);
    return;
  case FieldType::material:
  case FieldType::integer: {
    int value = -1;
    if (!(field.type == FieldType::material && text == "none") && !parse_number(text, value))
      throw bad_value(field, text);
    assign(value);
    return;
  }
  case FieldType::real: {
    float value = 0;
    if (!parse_number(text, value)) throw bad_value(field, text);
    assign(value);
    return;
  }
  case FieldType::angle: {
    double value = 0;
    if (!parse_number(text, value)) throw bad_value(field, text);
    assign(angle_value(value));
    return;
  }
  case FieldType::choice:
    for (std::size_t i = 0; i < field.choices.size(); ++i)
      if (field.choices[i] == text) {
        int value = static_cast<int>(i);
        std::memcpy(address, &value, sizeof value);
        return;
      }
    throw bad_value(field, text);
  case FieldType::point:
  case FieldType::color: {
    vec3 value;
    read_vector(field, value, text);
    assign(value);
    return;
  }
  }
}

std::string field_problem(const FieldInfo& field, const void* address) {
  auto check = [&](double value) -> std::string {
    if (std::isnan(value)) return "is not a number";
    if (std::isinf(value)) return "is not finite";
    if (!in_range(field, value)) return fmt::format("{} is out of range", value);
    return {};
  };
  switch (field.type) {
  case FieldType::boolean: return {};
  case FieldType::integer:
  case FieldType::material: return check(as<int>(address));
  case FieldType::real: return check(static_cast<double>(as<float>(address)));
  case FieldType::angle:
    // Compared in float: 180 degrees must pass though pi in float is a little more than pi.
    return check(static_cast<double>(
        static_cast<float>(static_cast<double>(as<float>(address)) * (180.0 / std::numbers::pi))));
  case FieldType::choice: {
    int value = load_choice(address);
    return value >= 0 && value < static_cast<int>(field.choices.size()) ? "" : "is not one of the choices";
  }
  case FieldType::point:
  case FieldType::color:
    for (int i = 0; i < 3; ++i)
      if (auto problem = check(static_cast<double>(as<vec3>(address)[i])); !problem.empty()) return problem;
    return {};
  }
  return {};
}

bool field_equal(const FieldInfo& field, const void* a, const void* b) {
  switch (field.type) {
  case FieldType::boolean: return as<bool>(a) == as<bool>(b);
  case FieldType::integer:
  case FieldType::material: return as<int>(a) == as<int>(b);
  case FieldType::choice: return load_choice(a) == load_choice(b);
  case FieldType::real:
  case FieldType::angle: return as<float>(a) == as<float>(b);
  case FieldType::point:
  case FieldType::color: return as<vec3>(a) == as<vec3>(b);
  }
  return false;
}

void field_copy(const FieldInfo& field, void* to, const void* from) {
  switch (field.type) {
  case FieldType::boolean: *static_cast<bool*>(to) = as<bool>(from); return;
  case FieldType::integer:
  case FieldType::material: *static_cast<int*>(to) = as<int>(from); return;
  case FieldType::choice: std::memcpy(to, from, sizeof(int)); return;
  case FieldType::real:
  case FieldType::angle: *static_cast<float*>(to) = as<float>(from); return;
  case FieldType::point:
  case FieldType::color: *static_cast<vec3*>(to) = as<vec3>(from); return;
  }
}

std::string field_domain(const FieldInfo& field) {
  if (field.type == FieldType::boolean) return "true or false";
  if (field.type == FieldType::material) return "a material of the scene, by name or index";
  if (field.type == FieldType::choice) return fmt::format("one of {}", fmt::join(field.choices, ", "));
  std::string_view what = field.type == FieldType::integer ? "an integer"
                          : field.type == FieldType::color ? "a colour (r g b)"
                          : field.type == FieldType::point ? "a point (x y z)"
                                                           : "a number";
  std::string_view unit = field.type == FieldType::angle ? "degrees" : field.unit;
  std::string range;
  bool low = std::isfinite(field.minimum), high = std::isfinite(field.maximum);
  auto bound = [&](double x) { return bound_text(x, field.type == FieldType::integer); };
  if (low) range = fmt::format(" {} {}", field.above_minimum ? "above" : "from", bound(field.minimum));
  if (low && high)
    range += fmt::format("{} {}", field.above_minimum ? " and at most" : " to", bound(field.maximum));
  else if (high)
    range = fmt::format(" of at most {}", bound(field.maximum));
  return fmt::format("{}{}{}{}", what, range, unit.empty() ? "" : ", in ", unit);
}

std::string nearest_name(std::string_view typed, std::span<const std::string_view> names) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, typed.size() / 3) + 1;
  for (std::string_view name : names) { // Levenshtein distance, one row
    std::vector<std::size_t> row(name.size() + 1);
    for (std::size_t j = 0; j <= name.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= typed.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= name.size(); ++j) {
        std::size_t substitute = diagonal + (typed[i - 1] != name[j - 1]);
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
      }
    }
    if (row[name.size()] < best_distance) best_distance = row[name.size()], best = name;
  }
  return best;
}

} // namespace candela
