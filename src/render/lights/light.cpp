#include "render/lights/light.h"

#include "core/color.h"
#include "render/lights/light_points.h"

namespace candela {

namespace {

/// Of a point of a flat light: its own error, and the rounding of its surface's intersection test as in
/// Geometry::surface.
vec3 flat_point_error(vec3 corner, vec3 edge1, vec3 edge2) {
  return gamma_bound(6) * (glm::abs(corner) + glm::abs(edge1) + glm::abs(edge2)) +
         gamma_bound(8) * max_component(glm::max(glm::abs(edge1), glm::abs(edge2)));
}

/// Filled in where it is: copies of what has just been written by parts stall the processor.
void set_towards(LightSample& s, const LightReference& ref, vec3 point, vec3 point_error, vec3 normal,
                 vec3 radiance, float pdf) {
  s.direction = glm::normalize(point - ref.position);
  s.point = point;
  s.point_error = point_error;
  s.point_normal = normal;
  s.radiance = radiance;
  s.pdf = pdf;
}

} // namespace

std::optional<LightSample> TriangleLight::sample(const LightReference& ref, vec2 u) const {
  if (!faces(ref, corner, normal, two_sided)) return std::nullopt;
  vec3 b = sample_uniform_triangle(u);
  vec3 p = corner + b.y * edge1 + b.z * edge2;
  float density = solid_angle_density(ref, p, normal, area, two_sided);
  if (!(density > 0)) return std::nullopt;
  std::optional<LightSample> s;
  set_towards(s.emplace(), ref, p, flat_point_error(corner, edge1, edge2), normal, emission, density);
  return s;
}

float TriangleLight::pdf(const LightReference& ref, vec3 point, vec3) const {
  return solid_angle_density(ref, point, normal, area, two_sided);
}

RectangleLight::RectangleLight(vec3 c, vec3 x, vec3 y, vec3 radiance, bool both_sides)
    : corner(c), edge_x(x), edge_y(y), normal(glm::normalize(glm::cross(x, y))), axis_x(glm::normalize(x)),
      axis_y(glm::normalize(y)), length_x(glm::length(x)), length_y(glm::length(y)),
      point_error(flat_point_error(c, x, y)), emission(radiance), two_sided(both_sides) {}

namespace {

SphericalRectangle seen_from(const RectangleLight& light, const LightReference& ref) {
  return {light.corner,   light.axis_x,   light.axis_y, light.normal,
          light.length_x, light.length_y, ref.position};
}

} // namespace

std::optional<LightSample> RectangleLight::sample(const LightReference& ref, vec2 u) const {
  if (!faces(ref, corner, normal, two_sided)) return std::nullopt;
  SphericalRectangle seen = seen_from(*this, ref);
  RectanglePoint p = point_on(*this, ref, u, seen.place(u), seen.solid_angle);
  std::optional<LightSample> s;
  if (p.pdf > 0) set_towards(s.emplace(), ref, p.position, point_error, normal, emission, p.pdf);
  return s;
}

float RectangleLight::pdf(const LightReference& ref, vec3 point, vec3) const {
  if (!faces(ref, corner, normal, two_sided)) return 0;
  float solid_angle = seen_from(*this, ref).solid_angle;
  if (solid_angle >= SphericalRectangle::kMinSolidAngle) return 1 / solid_angle;
  return solid_angle_density(ref, point, normal, area(), two_sided);
}

std::optional<LightSample> SphereLight::sample(const LightReference& ref, vec2 u) const {
  vec3 to_center = center - ref.position;
  SpherePoint p;
  if (length_squared(to_center) > sqr(radius)) {
    p = point_towards(to_center, radius, u);
  } else {
    if (!two_sided) return std::nullopt;
    p.normal = sample_uniform_sphere(u);
    p.pdf = solid_angle_density(ref, center + radius * p.normal, p.normal, 4 * kPi * sqr(radius), true);
    if (!(p.pdf > 0)) return std::nullopt;
  }
  vec3 offset = radius * p.normal;
  std::optional<LightSample> s;
  set_towards(s.emplace(), ref, center + offset, sphere_point_error(center, offset), p.normal, emission,
              p.pdf);
  return s;
}

float SphereLight::pdf(const LightReference& ref, vec3 point, vec3) const {
  float distance2 = length_squared(center - ref.position), radius2 = sqr(radius);
  if (distance2 > radius2) return uniform_cone_pdf(one_minus_cos_from_sin2(radius2 / distance2));
  if (!two_sided) return 0;
  return solid_angle_density(ref, point, (point - center) / radius, 4 * kPi * radius2, true);
}

std::optional<LightSample> DiscLight::sample(const LightReference& ref, vec2 u) const {
  if (!faces(ref, center, normal, two_sided)) return std::nullopt;
  vec2 d = radius * sample_uniform_disc(u);
  Basis frame = Basis::from_normal(normal);
  vec3 p = center + d.x * frame.s + d.y * frame.t;
  float density = solid_angle_density(ref, p, normal, kPi * sqr(radius), two_sided);
  if (!(density > 0)) return std::nullopt;
  std::optional<LightSample> s;
  set_towards(s.emplace(), ref, p, gamma_bound(6) * (glm::abs(center) + radius), normal, emission, density);
  return s;
}

float DiscLight::pdf(const LightReference& ref, vec3 point, vec3) const {
  return solid_angle_density(ref, point, normal, kPi * sqr(radius), two_sided);
}

namespace {

/// What LightDesc::attenuation divides by.
template <class T>
T attenuation_at(T r, vec3 attenuation) {
  T a(attenuation.x), b(attenuation.y), c(attenuation.z);
  return a + b * r + c * (r * r);
}

/// Of a light at a point whose intensity towards the reference is `intensity`.
std::optional<LightSample> sample_point(const LightReference& ref, vec3 position, vec3 intensity,
                                        vec3 attenuation) {
  float distance2 = length_squared(position - ref.position);
  if (!(distance2 > 0)) return std::nullopt;
  float divisor = attenuation.z * distance2;
  if (attenuation.x > 0 || attenuation.y > 0) divisor = attenuation_at(std::sqrt(distance2), attenuation);
  std::optional<LightSample> s;
  set_towards(s.emplace(), ref, position, vec3(0), vec3(0), intensity / divisor, 1);
  s->delta = true;
  return s;
}

} // namespace

std::optional<LightSample> PointLight::sample(const LightReference& ref, vec2) const {
  return sample_point(ref, position, intensity, attenuation);
}

float SpotLight::falloff(float angle) const {
  if (angle >= cutoff_angle) return 0;
  return angle <= beam_width ? 1 : (cutoff_angle - angle) / (cutoff_angle - beam_width);
}

std::optional<LightSample> SpotLight::sample(const LightReference& ref, vec2) const {
  vec3 d = ref.position - position;
  float share = falloff(std::atan2(glm::length(glm::cross(axis, d)), glm::dot(axis, d)));
  if (share == 0) return std::nullopt;
  return sample_point(ref, position, share * intensity, attenuation);
}

std::optional<LightSample> DirectionalLight::sample(const LightReference&, vec2) const {
  LightSample s;
  s.direction = -direction;
  s.radiance = irradiance;
  s.pdf = 1;
  s.delta = s.infinite = true;
  return s;
}

std::optional<LightSample> ConstantLight::sample(const LightReference& ref, vec2 u) const {
  const bool behind = ref.transmits && u.x < 0.5f;
  if (ref.transmits) u.x = std::min(behind ? 2 * u.x : 2 * u.x - 1, kOneMinusEpsilon);
  vec3 local = sample_cosine_hemisphere(u);
  if (!(local.z > 0)) return std::nullopt;
  LightSample s;
  if (behind) local.z = -local.z;
  s.direction = Basis::from_normal(ref.normal).to_world(local);
  s.radiance = radiance;
  s.pdf = pdf(ref, {}, s.direction);
  s.infinite = true;
  if (!(s.pdf > 0)) return std::nullopt; // the frame rounds
  return s;
}

std::optional<LightSample> EnvironmentLight::sample(const LightReference& ref, vec2 u) const {
  auto seen = map->sample(u, ref.environment_aim());
  if (!seen) return std::nullopt;
  LightSample s;
  s.direction = world_from_map * seen->direction;
  s.radiance = factor * seen->radiance;
  s.pdf = seen->pdf;
  s.infinite = true;
  return s;
}

float light_power(const Light& light, float scene_radius) {
  auto area_power = [](vec3 emission, float area, bool two_sided) {
    return luminance(emission) * area * kPi * (two_sided ? 2.0f : 1.0f);
  };
  float section = kPi * sqr(scene_radius); // of the scene, for what comes from afar
  // A reference as far away as the scene is large, for what does not fall with the square of the distance.
  auto distant = [&](vec3 attenuation) {
    double r = static_cast<double>(scene_radius);
    return static_cast<float>(r * r / attenuation_at(r, attenuation));
  };
  struct Visitor {
    decltype(area_power)& area;
    decltype(distant)& relative;
    float section;
    float operator()(const TriangleLight& l) const { return area(l.emission, l.area, l.two_sided); }
    float operator()(const RectangleLight& l) const { return area(l.emission, l.area(), l.two_sided); }
    float operator()(const SphereLight& l) const {
      return area(l.emission, 4 * kPi * sqr(l.radius), l.two_sided);
    }
    float operator()(const DiscLight& l) const { return area(l.emission, kPi * sqr(l.radius), l.two_sided); }
    float operator()(const PointLight& l) const {
      return 4 * kPi * luminance(l.intensity) * relative(l.attenuation);
    }
    float operator()(const SpotLight& l) const { // the integral of falloff over the sphere
      float ramp = l.cutoff_angle - l.beam_width;
      float mean_cosine = ramp > 1e-4f ? (std::sin(l.cutoff_angle) - std::sin(l.beam_width)) / ramp
                                       : std::cos(l.cutoff_angle);
      return 2 * kPi * (1 - mean_cosine) * luminance(l.intensity) * relative(l.attenuation);
    }
    float operator()(const DirectionalLight& l) const { return luminance(l.irradiance) * section; }
    float operator()(const ConstantLight& l) const { return luminance(l.radiance) * 4 * kPi * section; }
    float operator()(const EnvironmentLight& l) const {
      return luminance(l.factor) * l.map->total_luminance() * section;
    }
  };
  return std::visit(Visitor{area_power, distant, section}, light);
}

} // namespace candela
