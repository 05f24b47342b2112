#include "render/world/emitter_texture.h"

#include "render/world/texture_point.h"

namespace candela {

TexturePoint emitter_point(const RenderScene& scene, std::uint64_t emitter, vec3 point, bool asks_place) {
  Hit hit = scene.geometry().hit_at(emitter, point);
  hit.t = 0;
  return texture_point(scene, {point, 0, {0, 0, 1}, kInfinity}, hit, nullptr, asks_place);
}

} // namespace candela
