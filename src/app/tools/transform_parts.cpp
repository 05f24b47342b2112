#include "app/tools/transform_parts.h"

namespace candela {

namespace {

/// Orthonormal, right-handed columns of the matrix by Gram and Schmidt.
mat3 rotation_part(const mat4& m, vec3& scale) {
  vec3 x(m[0]), y(m[1]), z(m[2]);
  scale = {glm::length(x), glm::length(y), glm::length(z)};
  if (glm::dot(glm::cross(x, y), z) < 0) scale.x = -scale.x, x = -x;
  if (!(length_squared(x) > 0)) return mat3(1);
  x = glm::normalize(x);
  y -= glm::dot(x, y) * x;
  if (!(length_squared(y) > 0)) return mat3(1);
  y = glm::normalize(y);
  return {x, y, glm::cross(x, y)};
}

} // namespace

TransformParts transform_parts(const mat4& matrix) {
  TransformParts parts;
  parts.position = vec3(matrix[3]);
  const mat3 r = rotation_part(matrix, parts.scale);
  // R = Rz Ry Rx: its first column is (cz cy, sz cy, -sy).
  const float cy = std::hypot(r[0].x, r[0].y);
  vec3 angles(0, std::atan2(-r[0].z, cy), 0);
  if (cy > 1e-6f) {
    angles.x = std::atan2(r[1].z, r[2].z);
    angles.z = std::atan2(r[0].y, r[0].x);
  } else { // gimbal lock: only the sum or difference of x and z counts
    angles.x = std::atan2(-r[2].y, r[1].y);
  }
  for (int i = 0; i < 3; ++i) parts.rotation[i] = degrees(angles[i]) + 0.0f; // no -0
  return parts;
}

mat4 transform_of(const TransformParts& parts) {
  mat4 m = glm::translate(mat4(1), parts.position);
  m = glm::rotate(m, radians(parts.rotation.z), vec3(0, 0, 1));
  m = glm::rotate(m, radians(parts.rotation.y), vec3(0, 1, 0));
  m = glm::rotate(m, radians(parts.rotation.x), vec3(1, 0, 0));
  return glm::scale(m, parts.scale);
}

TransformParts about_middle(const mat4& before, TransformParts parts, vec3 middle) {
  parts.position = vec3(0);
  parts.position = transform_point(before, middle) - transform_point(transform_of(parts), middle);
  return parts;
}

bool has_shear(const mat4& matrix) {
  const mat4 again = transform_of(transform_parts(matrix));
  for (int c = 0; c < 3; ++c)
    if (glm::length(vec3(again[c]) - vec3(matrix[c])) > 1e-3f * glm::length(vec3(matrix[c]))) return true;
  return false;
}

} // namespace candela
