#include "lights/goniometric_light.h"

#include "core/color.h"
#include "lights/environment_light.h"
#include "lights/sky_model.h"

#include <numbers>

namespace candela {

Spectrum GoniometricLight::value(vec3 d) const {
  // The frame of a profile has its upward axis as z.
  if (profile != nullptr) return Spectrum(profile->intensity({d.x, -d.z, d.y}));
  return map->radiance(d);
}

Spectrum GoniometricLight::intensity(vec3 direction) const {
  const vec3 d = glm::normalize(local(direction));
  const float share = cone.is_sphere() ? 1 : cone.falloff(std::atan2(std::hypot(d.x, d.z), -d.y));
  return share > 0 ? share * factor * value(d) : Spectrum(0);
}

std::optional<LightSample> GoniometricLight::sample(const LightSamplingContext& ctx, vec2) const {
  const vec3 d = ctx.position - position;
  if (!(length_squared(d) > 0)) return std::nullopt;
  const Spectrum towards = intensity(d);
  if (is_black(towards)) return std::nullopt;
  return Attenuation{attenuation}.sample(ctx, position, towards);
}

float GoniometricLight::power(float scene_radius) const {
  return 4 * kPi * mean * luminance(factor) *
         Attenuation{attenuation}.relative_to_inverse_square(scene_radius);
}

std::optional<LightBounds> GoniometricLight::bounds() const {
  if (!Attenuation{attenuation}.inverse_square()) return std::nullopt;
  LightBounds b =
      omnidirectional_bounds(position, 0, typical_irradiance() / static_cast<double>(attenuation.z));
  b.axis = -up;
  // What is left at the outer edge may be as bright as anything beyond `inner`: the cosine that the tree
  // takes it for must not vanish there.
  b.theta_o = std::max(inner, outer - kPi / 3);
  b.theta_e = std::max(outer - b.theta_o, 0.0f);
  b.theta_o = std::min(b.theta_o + kBoundsConeSlack, kPi);
  return b;
}

double GoniometricLight::typical_irradiance() const {
  return static_cast<double>(luminance(factor) * maximum);
}

namespace {

/// The angles from the axis beyond which values are at most half of `maximum`, and 0.
class Extent {
public:
  explicit Extent(float maximum) : half_(0.5f * maximum) {}
  /// Up to that angle there are such values.
  void add(float angle, float value) {
    if (value > half_) inner = std::max(inner, angle);
    if (value > 0) outer = std::max(outer, angle);
  }
  float inner = 0, outer = 0;

private:
  float half_;
};

} // namespace

/// Sets maximum, inner and outer.
void GoniometricLight::measure(const Panorama* picture) {
  if (picture != nullptr) {
    const Image& image = picture->image;
    maximum = 0;
    for (vec3 texel : image.pixels) maximum = std::max(maximum, luminance(texel));
    Extent extent(maximum);
    for (int y = 0; y < image.height; ++y) {
      // A row reaches to the centres of the next ones.
      const float angle =
          std::min(kPi * (1 - (static_cast<float>(y) - 0.5f) / static_cast<float>(image.height)), kPi);
      for (int x = 0; x < image.width; ++x) extent.add(angle, luminance(image.at(x, y)));
    }
    inner = extent.inner, outer = extent.outer;
  } else {
    maximum = profile->maximum();
    Extent extent(maximum);
    const std::size_t n = profile->vertical.size();
    for (std::size_t i = 0; i < profile->candela.size(); ++i) // a node reaches to the next
      extent.add(profile->vertical[std::min(i % n + 1, n - 1)], profile->candela[i]);
    const bool about_nadir = profile->type == PhotometricType::c;
    inner = about_nadir ? extent.inner : kPi, outer = about_nadir ? extent.outer : kPi;
  }
  outer = std::min(outer, cone.cutoff_angle);
  inner = std::min(inner, outer);
}

/// Of the luminance over the whole sphere, times the cone's falloff: midpoints in the angles, beam and ramp
/// apart for the kink between them.
double GoniometricLight::mean_in_cone() const {
  constexpr int kRings = 192, kTurns = 96;
  auto integral = [&](double from, double to) {
    const double step = (to - from) / kRings, turn = 2 * std::numbers::pi / kTurns;
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
      const double theta = from + (i + 0.5) * step;
      double ring = 0;
      for (int k = 0; k < kTurns; ++k) {
        const double phi = (k + 0.5) * turn;
        ring += static_cast<double>(luminance(value(vec3(glm::dvec3(
            std::sin(theta) * std::cos(phi), -std::cos(theta), std::sin(theta) * std::sin(phi))))));
      }
      sum += ring * std::sin(theta) * static_cast<double>(cone.falloff(static_cast<float>(theta)));
    }
    return sum * step * turn;
  };
  const auto beam = static_cast<double>(cone.beam_width), cutoff = static_cast<double>(cone.cutoff_angle);
  return (integral(0, beam) + (cutoff > beam ? integral(beam, cutoff) : 0)) / (4 * std::numbers::pi);
}

GoniometricLight goniometric_light(const GoniometricDesc& desc, const LightResources& resources) {
  GoniometricLight light;
  light.position = desc.position;
  const mat3 world_from_local = turned_about_up(-desc.direction, desc.roll);
  light.x_axis = world_from_local[0], light.up = world_from_local[1];
  light.attenuation = desc.attenuation;
  light.cone = desc.cone;
  light.profile = desc.profile;
  if (desc.profile == nullptr) {
    EnvironmentLightModel picture;
    picture.panorama = desc.picture;
    light.map = resources.environment_map(picture);
  }
  light.measure(desc.profile == nullptr ? desc.picture.get() : nullptr);
  if (!light.cone.is_sphere())
    light.mean = static_cast<float>(light.mean_in_cone());
  else if (desc.profile != nullptr)
    light.mean = static_cast<float>(desc.profile->flux() / (4 * std::numbers::pi));
  else
    light.mean = light.map->total_luminance() / (4 * kPi);
  switch (desc.strength) {
  case ProfileStrength::file:
    light.factor = desc.color * (desc.profile != nullptr ? static_cast<float>(1 / kDaylightEfficacy) : 1.0f);
    break;
  case ProfileStrength::peak:
    light.factor = light.maximum > 0 ? desc.color / light.maximum : Spectrum(0);
    break;
  case ProfileStrength::power:
    light.factor = light.mean > 0 ? desc.color / (4 * kPi * light.mean) : Spectrum(0);
    break;
  }
  return light;
}

} // namespace candela
