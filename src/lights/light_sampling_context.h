#pragma once
// The point that a light is sampled for.

#include "bsdf/lobe_proxy.h"
#include "core/basis.h"
#include "lights/environment_map.h"

namespace candela {

/// Directions from which a point scatters light.
enum class ScatteringDomain : std::uint8_t {
  hemisphere, ///< a surface that reflects: about the normal
  sphere,     ///< a surface that transmits with a density, too
  volume,     ///< a point in a medium: all alike, there is no normal and no cosine
};

/// What sampling a light, and choosing one, needs to know of a shading point.
struct LightSamplingContext {
  vec3 position{0};
  vec3 normal{0, 0, 1}; ///< unit geometric normal, turned to the side that reflects; of `volume`: unused
  ScatteringDomain domain = ScatteringDomain::hemisphere;
  /// The point's BSDF is sampled, too, and both are combined by MIS: a light may leave to BSDF sampling what
  /// that finds well.
  bool mis_with_bsdf = false;
  LobeProxy lobe{};  ///< of the point's BSDF, for choosing among several lights
  vec3 lobe_axis{0}; ///< unit, of the lobe's peak

  static LightSamplingContext in_volume(vec3 position) {
    return {position, vec3(0), ScatteringDomain::volume, false, {}, vec3(0)};
  }

  /// Whether light sampling may give such a direction. What chooses lights, samples them and weights light
  /// that BSDF sampling found must all ask this one. By the cosine with `normal`, or by a unit direction.
  bool accepts(float cosine) const {
    return cosine > 0 ||
           (domain != ScatteringDomain::hemisphere && (cosine < 0 || domain == ScatteringDomain::volume));
  }
  bool accepts(vec3 direction) const { return accepts(glm::dot(normal, direction)); }
  /// What light from there is weighted by, whatever the BSDF.
  float cosine_factor(vec3 direction) const {
    return domain == ScatteringDomain::volume ? 1 : std::abs(glm::dot(direction, normal));
  }

  EnvironmentDensity environment_density() const {
    return mis_with_bsdf ? EnvironmentDensity::compensated : EnvironmentDensity::full;
  }
};

} // namespace candela
