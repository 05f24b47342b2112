#pragma once
// The list of what scenes are made of for shading. A new primitive kind is an entry of
// accel/primitives/primitive_kinds.h, a file of this folder, and its name here; hits, texture coordinates,
// lights, numbers and the build follow from it.

#include "render/world/curve_surfaces.h"
#include "render/world/disc_surfaces.h"
#include "render/world/instance_surfaces.h"
#include "render/world/moving_instance_surfaces.h"
#include "render/world/moving_triangle_surfaces.h"
#include "render/world/sphere_surfaces.h"
#include "render/world/triangle_surfaces.h"

namespace candela {

using SurfaceKinds = SurfaceKindList<TriangleSurfaces, SphereSurfaces, DiscSurfaces, InstanceSurfaces,
                                     CurveSurfaces, MovingInstanceSurfaces, MovingTriangleSurfaces>;

} // namespace candela
