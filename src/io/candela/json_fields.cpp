#include "io/candela/json_fields.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace candela {

namespace {

std::string_view type_name(JsonType type) {
  switch (type) {
  case JsonType::null: return "null";
  case JsonType::boolean: return "true or false";
  case JsonType::number: return "a number";
  case JsonType::string: return "a string";
  case JsonType::array: return "an array";
  case JsonType::object: return "an object";
  }
  return "";
}

std::string shortened_token(std::string_view token) {
  constexpr std::size_t kLongest = 60;
  return std::string(token.size() > kLongest ? token.substr(0, kLongest) : token);
}

/// The value as the text that field_from_text reads; nothing if its type does not fit the field.
std::optional<std::string> text_of(const FieldInfo& field, JsonValue value) {
  auto if_type = [&](JsonType type) {
    return value.type() == type ? std::optional(std::string(value.token())) : std::nullopt;
  };
  switch (field.type) {
  case FieldType::boolean: return if_type(JsonType::boolean);
  case FieldType::integer:
  case FieldType::material:
  case FieldType::real:
  case FieldType::angle: return if_type(JsonType::number);
  case FieldType::choice:
    return value.type() == JsonType::string ? std::optional(value.string()) : std::nullopt;
  case FieldType::color:
    if (value.type() == JsonType::number) return if_type(JsonType::number);
    [[fallthrough]];
  case FieldType::point: {
    if (value.type() != JsonType::array || value.size() != 3) return std::nullopt;
    std::string text;
    for (JsonValue part : value) {
      if (part.type() != JsonType::number) return std::nullopt;
      text += fmt::format("{} ", part.token());
    }
    return text;
  }
  }
  return std::nullopt;
}

/// The allowed values, in the syntax of JSON.
std::string domain(const FieldInfo& field) {
  std::string words = field_domain(field);
  if (field.type == FieldType::point) words = "[x, y, z]";
  if (field.type == FieldType::color)
    words = "[r, g, b] or one number for a grey" + words.substr(std::string_view("a colour (r g b)").size());
  return words;
}

} // namespace

void read_field(const FieldInfo& field, void* address, JsonValue value, std::string_view element) {
  auto refuse = [&](std::string_view cause) {
    return input_error(value.where(), element, cause, fmt::format("give {}", domain(field)));
  };
  auto text = text_of(field, value);
  if (!text) throw refuse(fmt::format("{} does not fit", type_name(value.type())));
  try {
    field_from_text(field, address, *text);
  } catch (const Error&) { // a usage error without a location
    throw refuse(fmt::format("'{}' does not fit", shortened_token(*text)));
  }
}

std::string field_json(const FieldInfo& field, const void* address) {
  std::string text = field_to_text(field, address);
  switch (field.type) {
  case FieldType::choice: return json_quoted(text);
  case FieldType::point:
  case FieldType::color: {
    std::string out = "[";
    for (char c : text) out += c == ' ' ? std::string(", ") : std::string(1, c);
    return out + "]";
  }
  default: return text;
  }
}

void expect(JsonValue value, JsonType type, std::string_view element) {
  if (value.type() != type)
    throw input_error(value.where(), element, fmt::format("{} does not fit", type_name(value.type())),
                      fmt::format("give {}", type_name(type)));
}

std::string read_string(JsonValue value, std::string_view element) {
  expect(value, JsonType::string, element);
  return value.string();
}

double read_double(JsonValue value, std::string_view element) {
  expect(value, JsonType::number, element);
  std::string_view token = value.token();
  double out = 0; // stays 0 below the range of a double
  auto status = std::from_chars(token.data(), token.data() + token.size(), out).ec;
  const bool tiny = token.find("e-") != token.npos || token.find("E-") != token.npos;
  if ((status == std::errc() || tiny) &&
      std::abs(out) <= static_cast<double>(std::numeric_limits<float>::max()))
    return out;
  throw input_error(value.where(), element, fmt::format("{} is too large", shortened_token(token)),
                    "give a number below 3.4e38");
}

float read_real(JsonValue value, std::string_view element) {
  expect(value, JsonType::number, element);
  std::string_view token = value.token();
  float out = 0;
  auto status = std::from_chars(token.data(), token.data() + token.size(), out).ec;
  if (status == std::errc()) return out;
  // Out of the range of a float: from_chars does not distinguish too large from too small.
  return static_cast<float>(read_double(value, element));
}

int read_integer(JsonValue value, std::string_view element, int minimum, int maximum) {
  std::string_view token = value.token();
  int out = 0;
  auto [end, status] = std::from_chars(token.data(), token.data() + token.size(), out);
  bool whole =
      value.type() == JsonType::number && status == std::errc() && end == token.data() + token.size();
  if (!whole || out < minimum || out > maximum)
    throw input_error(value.where(), element, fmt::format("'{}' does not fit", shortened_token(token)),
                      fmt::format("give an integer from {} to {}", minimum, maximum));
  return out;
}

namespace {

template <class Real>
void read_array(JsonValue value, std::span<Real> out, std::string_view element,
                Real (*read)(JsonValue, std::string_view)) {
  if (value.type() != JsonType::array || value.size() != out.size())
    throw input_error(value.where(), element,
                      value.type() == JsonType::array
                          ? fmt::format("{} elements", value.size())
                          : fmt::format("{} does not fit", type_name(value.type())),
                      fmt::format("give an array of {} numbers", out.size()));
  auto it = out.begin();
  for (JsonValue part : value) *it++ = read(part, element);
}

} // namespace

void read_reals(JsonValue value, std::span<float> out, std::string_view element) {
  read_array(value, out, element, read_real);
}

void read_reals(JsonValue value, std::span<double> out, std::string_view element) {
  read_array(value, out, element, read_double);
}

vec2 read_vec2(JsonValue value, std::string_view element) {
  float v[2];
  read_reals(value, std::span<float>(v), element);
  return {v[0], v[1]};
}

vec3 read_vec3(JsonValue value, std::string_view element) {
  float v[3];
  read_reals(value, std::span<float>(v), element);
  return {v[0], v[1], v[2]};
}

Error unknown_key(JsonValue key, std::string_view element, std::span<const std::string_view> known) {
  std::string near = nearest_name(key.string(), known);
  return input_error(key.where(), element, fmt::format("there is no key '{}'", shortened_token(key.string())),
                     near.empty() ? fmt::format("the keys are {}", fmt::join(known, ", "))
                                  : fmt::format("did you mean '{}'?", near));
}

} // namespace candela
