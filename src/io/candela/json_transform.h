#pragma once
// The "transform" of an instance in Candela JSON.

#include "core/math.h"
#include "io/candela/json_tree.h"

#include <string_view>

namespace candela {

/// Reads 16 numbers, row-major, or a list of steps (io/candela/candela_json.h). Throws input_error for what
/// is not affine, not finite or not invertible.
glm::dmat4 read_transform(JsonValue value, std::string_view element);

/// Rotation about an axis of any length but 0; exact for multiples of 90 degrees about a coordinate axis.
glm::dmat4 rotation(glm::dvec3 axis, double degrees);

/// Whether the matrix is finite, has the last row 0 0 0 1 and a linear part that is not singular; if not,
/// why.
std::string_view transform_problem(const glm::dmat4& m);

} // namespace candela
