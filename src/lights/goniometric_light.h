#pragma once
// A point whose intensity depends on the direction as a file says.

#include "lights/attenuation.h"
#include "lights/ies_profile.h"
#include "lights/light_bounds.h"
#include "lights/light_rows.h"
#include "lights/panorama.h"

#include <memory>

namespace candela {

/// The cone of a spot light: full within beam_width of the axis, falling linearly with the angle from there
/// to nothing at cutoff_angle, as in Mitsuba. Radians, beam_width <= cutoff_angle.
struct SpotCone {
  float beam_width = 0, cutoff_angle = 0;

  /// Whether it cuts nothing.
  bool is_sphere() const { return beam_width >= kPi; }
  /// Share of the intensity at an angle to the axis.
  float falloff(float angle) const {
    if (angle >= cutoff_angle) return 0;
    return angle <= beam_width ? 1 : (cutoff_angle - angle) / (cutoff_angle - beam_width);
  }
};

/// A point that shines as a photometric file or a picture says, cut by a cone if that is narrower than the
/// sphere. In the light's own frame +y is up as a luminaire hangs, so that -y is its nadir and the axis of
/// the cone; +x is its photometric horizontal, and -z a quarter turn on from that, by the angles of type C. A
/// picture has latitude and longitude as EnvironmentMap has them.
struct GoniometricLight {
  vec3 position{0};
  vec3 x_axis{1, 0, 0}, up{0, 1, 0};   ///< of the frame, in the world; unit
  const IesProfile* profile = nullptr; ///< one of the two; somebody else's
  const EnvironmentMap* map = nullptr;
  Spectrum factor{0}; ///< W/sr for a value of 1
  vec3 attenuation{0, 0, 1};
  SpotCone cone{kPi, kPi};
  float mean = 0, maximum = 0; ///< of the values' luminance: over the sphere, with the cone; the greatest
  float inner = 0, outer = 0;  ///< angles from the axis: beyond them no more than half of that, and nothing

  static constexpr std::string_view kName = "goniometric";
  static constexpr LightKind kind = LightKind::delta_position;

  /// W/sr in a direction away from the light, of any length.
  Spectrum intensity(vec3 direction) const;
  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2) const;
  float pdf(const LightSamplingContext&, vec3, vec3) const { return 0; }
  float power(float scene_radius) const;
  std::optional<LightBounds> bounds() const;
  double typical_irradiance() const;

private:
  friend GoniometricLight goniometric_light(const struct GoniometricDesc&, const LightResources&);
  vec3 local(vec3 direction) const {
    return {glm::dot(direction, x_axis), glm::dot(direction, up),
            glm::dot(direction, glm::cross(x_axis, up))};
  }
  Spectrum value(vec3 direction_local) const;
  void measure(const Panorama* picture);
  double mean_in_cone() const;
};

/// What such a light is made of: of a point or of a spot light.
struct GoniometricDesc {
  vec3 position, direction; ///< of the nadir, any length
  float roll;
  const IesProfile* profile;
  std::shared_ptr<const Panorama> picture;
  ProfileStrength strength;
  Spectrum color;
  vec3 attenuation;
  SpotCone cone;
};
GoniometricLight goniometric_light(const GoniometricDesc& desc, const LightResources& resources);

} // namespace candela
