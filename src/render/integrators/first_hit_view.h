#pragma once
// Views of what a camera ray meets first.

#include "render/integrators/transport.h"

namespace candela {

/// What a camera ray meets first, if `met`: `hit`, unless that is transparent or hidden.
/// - albedo: rough reflectance; - normal, geometric_normal: towards the viewer, 0.5 n + 0.5;
/// - depth: along `forward`, scene units; - optical_depth: of the media before it, the mean of the channels,
/// no
///   more than kGreatestOpticalDepth, also where nothing is met; - uv: fractional parts, red and green;
/// - material: a colour that the material's index chooses.
/// 0 where the ray leaves the scene. `media` are the ray's, in scenes with any. Textures are filtered over
/// the cone, unless it is null.
Spectrum first_hit_value(const RenderScene& scene, Ray ray, const MediumStack& media, bool met, Hit hit,
                         vec3 forward, View view, Sampler& sampler, RayCounts& counts,
                         const ConeOfRay* cone = nullptr);

/// Nothing of the light is left long before.
inline constexpr float kGreatestOpticalDepth = 1e4f;

/// For View::bvh_cost: the nodes and packs of primitives that the ray tests.
Spectrum bvh_cost_value(const RenderScene& scene, const Ray& ray, RayCounts& counts);

} // namespace candela
