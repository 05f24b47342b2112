#pragma once

#include "core/color.h"
#include "render/lights/light_bounds.h"
#include "render/lights/light_sample.h"

namespace candela {

/// A panorama, sampled in proportion to what it sends.
struct EnvironmentLight {
  const EnvironmentMap* map = nullptr;
  mat3 world_from_map{1.0f}; ///< a rotation
  Spectrum factor{1};

  static constexpr LightKind kind = LightKind::infinite;

  Spectrum radiance_from(vec3 direction) const { return factor * map->radiance(direction * world_from_map); }
  /// For looking up many directions: all are located, which sends for their texels, before the first is
  /// waited for. With a panorama of 2048 x 1024 that halves the time.
  EnvironmentMap::Place locate(vec3 direction) const { return map->locate(direction * world_from_map); }
  /// radiance_from() and pdf() at once.
  RadiancePdf radiance_pdf(const LightSamplingContext& ctx, const EnvironmentMap::Place& at) const {
    const auto found = map->lookup(at, ctx.environment_density());
    return {factor * found.radiance, found.pdf};
  }
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    auto found = map->sample(u, ctx.environment_density());
    if (!found) return std::nullopt;
    LightSample s;
    s.direction = world_from_map * found->direction;
    s.radiance = factor * found->radiance;
    s.pdf = found->pdf;
    s.infinite = true;
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3, vec3 direction) const {
    return map->pdf(direction * world_from_map, ctx.environment_density());
  }
  float power(float scene_radius) const {
    return luminance(factor) * map->total_luminance() * (kPi * sqr(scene_radius));
  }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double mean_irradiance(EnvironmentDensity density) const {
    return 0.25 * static_cast<double>(luminance(factor) * map->total_luminance(density));
  }
};

} // namespace candela
