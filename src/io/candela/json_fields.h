#pragma once
// JSON values of the rows of field tables (core/fields.h).

#include "core/fields.h"
#include "io/candela/json_tree.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// Reads a value into the field at `address`: true/false, a number (an angle in degrees), a string (a
/// choice), [x, y, z]; a colour may be one number, a grey. Throws input_error at the value for a wrong type
/// or range; `element` names it in the message ("materials[2].roughness").
void read_field(const FieldInfo& field, void* address, JsonValue value, std::string_view element);

/// The field's value in JSON, which reads back to the same bits.
std::string field_json(const FieldInfo& field, const void* address);

// Values without a row. All throw input_error at the value.
void expect(JsonValue value, JsonType type, std::string_view element);
std::string read_string(JsonValue value, std::string_view element);
float read_real(JsonValue value, std::string_view element);    ///< finite in float
double read_double(JsonValue value, std::string_view element); ///< the same in double precision
int read_integer(JsonValue value, std::string_view element, int minimum, int maximum);
/// An array of exactly out.size() finite numbers.
void read_reals(JsonValue value, std::span<float> out, std::string_view element);
void read_reals(JsonValue value, std::span<double> out, std::string_view element);
vec2 read_vec2(JsonValue value, std::string_view element);
vec3 read_vec3(JsonValue value, std::string_view element);

/// The error for an unknown key, with the nearest known key.
Error unknown_key(JsonValue key, std::string_view element, std::span<const std::string_view> known);

/// Reads a key that is a row of the table, if it is one.
template <class Owner>
bool read_row(std::span<const Field<Owner>> rows, std::type_identity_t<Owner>& owner, JsonValue key,
              JsonValue value, std::string_view element) {
  for (const auto& row : rows)
    if (row.key == key.string()) {
      read_field(row, row.address(owner), value, std::string(element) + "." + key.string());
      return true;
    }
  return false;
}

/// Whether one of `types` types has a value that the object's own type has not. It is read into a default
/// object of that type and dropped, so that a malformed value is an error whatever the object's type is.
template <class MakeDefault, class Read>
bool read_for_other_types(int types, MakeDefault make_default, Read read) {
  for (int type = 0; type < types; ++type) {
    auto other = make_default(type);
    if (read(other)) return true;
  }
  return false;
}

/// The keys of the rows and some more.
template <class Owner>
std::vector<std::string_view> keys_of(std::span<const Field<Owner>> rows,
                                      std::initializer_list<std::string_view> more) {
  std::vector<std::string_view> keys(more);
  for (const auto& row : rows) keys.push_back(row.key);
  return keys;
}

} // namespace candela
