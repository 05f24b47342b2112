#pragma once
// Field tables: one row describes one editable value of a struct, for all code that reads, writes, checks,
// documents or draws it.

#include "core/math.h"

#include <span>
#include <string>
#include <string_view>

namespace candela {

enum class FieldType {
  boolean,  ///< bool
  integer,  ///< int
  real,     ///< float
  angle,    ///< float, radians in the struct, degrees in files and panels
  choice,   ///< an enum whose underlying type is int; the value indexes `choices`
  point,    ///< vec3, a position or a direction
  color,    ///< vec3, linear Rec. 709
  material, ///< int, which of the scene's materials, by index; -1: none. Files give its name
};

/// What an edit of the field invalidates.
enum class Invalidates {
  nothing, ///< only when to stop, or how to run
  display, ///< the tone-mapped picture; never restarts the accumulation
  image,   ///< the accumulation: it restarts
  scene,   ///< geometry or lights too: they are rebuilt, then the accumulation restarts
};

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

struct FieldInfo {
  std::string_view key; ///< "path.max_depth"
  FieldType type = FieldType::real;
  double minimum = -kUnlimited; ///< in file units (degrees for angles)
  double maximum = kUnlimited;
  std::string_view unit; ///< "" where it has none
  std::string_view help;
  Invalidates invalidates = Invalidates::image;
  std::span<const std::string_view> choices = {};
  bool logarithmic = false;   ///< a slider should be logarithmic
  bool above_minimum = false; ///< the minimum itself does not fit
};

template <class Owner>
struct Field : FieldInfo {
  void* (*address)(Owner&) = nullptr;
};

/// The value at `address` as text: shortest form that reads back to the same float, "0.1 0.2 0.3" for
/// vectors.
std::string field_to_text(const FieldInfo& field, const void* address);

/// Reads text into the value; a usage error that names key, range or choices if it does not fit. Vectors take
/// spaces or commas; a colour or point of one number means three equal ones; booleans take true/false,
/// on/off, 1/0.
void field_from_text(const FieldInfo& field, void* address, std::string_view text);

/// Why the value at `address` does not fit its row (range, NaN, choice); empty if it does.
std::string field_problem(const FieldInfo& field, const void* address);

bool field_equal(const FieldInfo& field, const void* a, const void* b);
void field_copy(const FieldInfo& field, void* to, const void* from);

/// "a number from 0 to 1e9, in scene units" for documentation and messages.
std::string field_domain(const FieldInfo& field);

/// The name that is nearest to a mistyped one, for "did you mean"; empty if nothing is near.
std::string nearest_name(std::string_view typed, std::span<const std::string_view> names);

template <class Owner>
std::string field_text(const Field<Owner>& field, const Owner& owner) {
  return field_to_text(field, field.address(const_cast<Owner&>(owner)));
}

} // namespace candela
