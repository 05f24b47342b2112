#pragma once
// The "transform" of an instance in Candela JSON.

#include "core/math.h"
#include "io/candela/json_tree.h"

#include <string_view>

namespace candela {

/// Reads 16 numbers, row-major, or a list of steps (io/candela/candela_json.h). Throws input_error for
/// transforms that are not affine, finite and invertible.
glm::dmat4 read_transform(JsonValue value, std::string_view element);

/// Rotation about an axis of any length but 0; exact for multiples of 90 degrees about a coordinate axis.
glm::dmat4 rotation(glm::dvec3 axis, double degrees);

/// Why the matrix is not a finite affine transform with an inverse; empty if it is.
std::string_view transform_problem(const glm::dmat4& m);

} // namespace candela
