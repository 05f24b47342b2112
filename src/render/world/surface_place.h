#pragma once
// What textures may ask of a point of a surface beside its coordinates.

#include "render/world/render_scene.h"
#include "textures/texture_point.h"

namespace candela {

/// Of a hit of `ray`, whose tangents are those of Geometry. Colours are those of the mesh that was hit.
SurfacePlace surface_place(const RenderScene& scene, const Ray& ray, const Hit& hit,
                           const SurfaceTangents& tangents);

} // namespace candela
