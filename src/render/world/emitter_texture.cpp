#include "render/world/emitter_texture.h"

namespace candela {

vec2 emitter_uv(const Geometry& geometry, std::uint64_t emitter, vec3 point) {
  Hit hit = geometry.hit_at(emitter, point);
  hit.t = 0;
  return geometry.uv({point, 0, {0, 0, 1}, kInfinity}, hit);
}

} // namespace candela
