#pragma once
// Views of what a camera ray meets first.

#include "render/transport.h"

namespace candela {

/// - albedo: rough reflectance; - normal, geometric_normal: towards the viewer, 0.5 n + 0.5;
/// - depth: along `forward`, scene units; - uv: fractional parts, red and green;
/// - material: a colour that the material's index chooses;
/// - bvh_cost: nodes and packs of primitives that the ray tests.
/// 0 where the ray leaves the scene, but for bvh_cost.
vec3 first_hit_value(const RenderScene& scene, Ray ray, vec3 forward, View view, Sampler& sampler,
                     RayCounts& counts);

} // namespace candela
