#include "lights/projector_light.h"

namespace candela {

/// `place` in [0, 1]^2 from the upper left corner. The border is continued.
Spectrum ProjectorLight::texel_at(vec2 place) const {
  if (picture == nullptr) return Spectrum(1);
  const vec2 size(picture->width, picture->height);
  const vec2 at = glm::clamp(place * size - 0.5f, vec2(0), size - 1.0f);
  const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
  const int right_x = std::min(x + 1, picture->width - 1), below = std::min(y + 1, picture->height - 1);
  const vec2 f = at - vec2(x, y);
  return glm::mix(glm::mix(picture->at(x, y), picture->at(right_x, y), f.x),
                  glm::mix(picture->at(x, below), picture->at(right_x, below), f.x), f.y);
}

Spectrum ProjectorLight::intensity_towards(vec3 d) const {
  const float forward = glm::dot(d, axis());
  if (!(forward > 0)) return Spectrum(0);
  const vec2 place = vec2(glm::dot(d, right), glm::dot(d, up)) / (forward * half_size);
  if (!(std::abs(place.x) <= 1 && std::abs(place.y) <= 1)) return Spectrum(0);
  const float inverse_cosine = glm::length(d) / forward;
  return intensity * texel_at({0.5f + 0.5f * place.x, 0.5f - 0.5f * place.y}) *
         (inverse_cosine * inverse_cosine * inverse_cosine);
}

std::optional<LightSample> ProjectorLight::sample(const LightSamplingContext& ctx, vec2) const {
  const Spectrum towards = intensity_towards(ctx.position - position);
  if (is_black(towards)) return std::nullopt;
  return Attenuation{attenuation}.sample(ctx, position, towards);
}

float ProjectorLight::power(float scene_radius) const {
  return 4 * half_size.x * half_size.y * mean * luminance(intensity) *
         Attenuation{attenuation}.relative_to_inverse_square(scene_radius);
}

std::optional<LightBounds> ProjectorLight::bounds() const {
  if (!Attenuation{attenuation}.inverse_square()) return std::nullopt;
  const float corner = glm::length(half_size), inverse_cosine = std::hypot(1.0f, corner);
  LightBounds b =
      omnidirectional_bounds(position, 0,
                             typical_irradiance() * std::pow(static_cast<double>(inverse_cosine), 3) /
                                 static_cast<double>(attenuation.z));
  b.axis = axis();
  b.theta_o = std::min(std::atan(corner) + kBoundsConeSlack, kPi);
  b.theta_e = 0;
  return b;
}

ProjectorLight light_of(const ProjectorLightModel& m, Spectrum color, const LightResources&) {
  ProjectorLight light;
  light.position = m.position;
  light.intensity = color;
  light.attenuation = m.attenuation;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(m.direction));
  glm::dvec3 right = glm::cross(axis, glm::dvec3(0, 1, 0));
  right = glm::length(right) > 1e-6 ? glm::normalize(right) : glm::dvec3(1, 0, 0);
  const glm::dvec3 up = glm::cross(right, axis);
  const auto roll = static_cast<double>(m.roll);
  light.right = vec3(std::cos(roll) * right - std::sin(roll) * up);
  light.up = vec3(std::cos(roll) * up + std::sin(roll) * right);
  const float half = std::tan(0.5f * m.vertical_fov);
  light.half_size = vec2(half);
  if (m.panorama) {
    const Image& image = m.panorama->image;
    light.picture = &image;
    light.half_size.x = half * static_cast<float>(image.width) / static_cast<float>(image.height);
    double sum = 0;
    light.maximum = 0;
    for (vec3 texel : image.pixels) {
      const float l = luminance(texel);
      sum += static_cast<double>(l), light.maximum = std::max(light.maximum, l);
    }
    light.mean = static_cast<float>(sum / static_cast<double>(image.pixels.size()));
  }
  return light;
}

} // namespace candela
