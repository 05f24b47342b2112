#pragma once
// Absorbing bodies: what a ray is inside of, and what is left of the light on its way there.

#include "render/world/render_scene.h"

#include <array>

namespace candela {

/// The bodies of dielectrics that a point lies in, the innermost last, each by the interior of its surface
/// (SurfaceMaterial::interior). The innermost one's absorbs; of bodies that overlap, the one that was entered
/// last. An eighth body in bodies makes it forget the outermost.
class Interiors {
public:
  /// Through a surface whose inside has this interior; kNoInterior changes nothing.
  void enter(std::uint16_t interior);
  /// Out again; nothing where it was not inside.
  void leave(std::uint16_t interior);
  /// enter() for a ray that comes from outside, else leave().
  void cross(std::uint16_t interior, bool from_outside) { from_outside ? enter(interior) : leave(interior); }

  bool empty() const { return count_ == 0; }
  std::uint16_t innermost() const { return count_ > 0 ? bodies_[count_ - 1u] : kNoInterior; }

private:
  std::array<std::uint16_t, 7> bodies_{};
  std::uint16_t count_ = 0;
};

/// Beer and Lambert: exp(-absorption distance), the share of light that passes `distance` (scene units; may
/// be infinite) inside of the innermost body.
vec3 transmittance(const RenderScene& scene, const Interiors& interiors, float distance);

/// What a point lies in. Six rays ask: a body counts where half of them leave it without having entered, so
/// that one that has holes, or a plane that divides space, has an inside, too.
Interiors interiors_at(const RenderScene& scene, vec3 point);
/// `interiors` of `from` become those of `to`.
void move_between(const RenderScene& scene, vec3 from, vec3 to, Interiors& interiors);

} // namespace candela
