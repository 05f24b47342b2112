#include "render/light.h"

#include "core/color.h"

namespace candela {

namespace {

/// From density per area to density per solid angle: r^2 / |cos theta|; 0 where the light is edge-on or shows
/// the side that does not shine.
float solid_angle_density(const LightReference& ref, vec3 point, vec3 normal, float area, bool two_sided) {
  vec3 d = point - ref.position;
  float distance2 = length_squared(d);
  float cosine = -glm::dot(normal, d); // times the distance
  if (two_sided) cosine = std::abs(cosine);
  if (!(cosine > 0) || !(distance2 > 0)) return 0;
  return distance2 * std::sqrt(distance2) / (cosine * area);
}

bool faces(const LightReference& ref, vec3 corner, vec3 normal, bool two_sided) {
  return two_sided || glm::dot(ref.position - corner, normal) > 0;
}

/// Of a point of a flat light: its own error, and the rounding of its surface's intersection test as in
/// Geometry::surface.
vec3 flat_point_error(vec3 corner, vec3 edge1, vec3 edge2) {
  return gamma_bound(6) * (glm::abs(corner) + glm::abs(edge1) + glm::abs(edge2)) +
         gamma_bound(8) * max_component(glm::max(glm::abs(edge1), glm::abs(edge2)));
}

LightSample towards(const LightReference& ref, vec3 point, vec3 point_error, vec3 normal, vec3 radiance,
                    float pdf) {
  LightSample s;
  s.direction = glm::normalize(point - ref.position);
  s.point = point;
  s.point_error = point_error;
  s.point_normal = normal;
  s.radiance = radiance;
  s.pdf = pdf;
  return s;
}

} // namespace

std::optional<LightSample> TriangleLight::sample(const LightReference& ref, vec2 u) const {
  if (!faces(ref, corner, normal, two_sided)) return std::nullopt;
  vec3 b = sample_uniform_triangle(u);
  vec3 p = corner + b.y * edge1 + b.z * edge2;
  float density = solid_angle_density(ref, p, normal, area, two_sided);
  if (!(density > 0)) return std::nullopt;
  return towards(ref, p, flat_point_error(corner, edge1, edge2), normal, emission, density);
}

float TriangleLight::pdf(const LightReference& ref, vec3 point, vec3) const {
  return solid_angle_density(ref, point, normal, area, two_sided);
}

std::optional<LightSample> RectangleLight::sample(const LightReference& ref, vec2 u) const {
  if (!faces(ref, corner, normal, two_sided)) return std::nullopt;
  vec3 error = flat_point_error(corner, edge_x, edge_y);
  SphericalRectangle seen(corner, edge_x, edge_y, ref.position);
  if (seen.solid_angle >= SphericalRectangle::kMinSolidAngle)
    return towards(ref, seen.sample(u), error, normal, emission, 1 / seen.solid_angle);
  vec3 p = corner + u.x * edge_x + u.y * edge_y;
  float density = solid_angle_density(ref, p, normal, area, two_sided);
  if (!(density > 0)) return std::nullopt;
  return towards(ref, p, error, normal, emission, density);
}

float RectangleLight::pdf(const LightReference& ref, vec3 point, vec3) const {
  if (!faces(ref, corner, normal, two_sided)) return 0;
  SphericalRectangle seen(corner, edge_x, edge_y, ref.position);
  if (seen.solid_angle >= SphericalRectangle::kMinSolidAngle) return 1 / seen.solid_angle;
  return solid_angle_density(ref, point, normal, area, two_sided);
}

std::optional<LightSample> SphereLight::sample(const LightReference& ref, vec2 u) const {
  vec3 to_center = center - ref.position;
  float distance2 = length_squared(to_center), radius2 = sqr(radius);
  vec3 n;
  float density;
  if (distance2 >
      radius2) { // pbrt-v4, section 6.2.4, the angle at the centre without cancellation for small cones
    float sin2_max = radius2 / distance2;
    float one_minus_cos_max = one_minus_cos_from_sin2(sin2_max);
    vec3 local = sample_uniform_cone(u, one_minus_cos_max); // about the direction to the centre
    float cos_theta = local.z, sin2_theta = 1 - sqr(cos_theta);
    if (sin2_max < 1e-3f) sin2_theta = local.x * local.x + local.y * local.y;
    float cos_alpha =
        sin2_theta / std::sqrt(sin2_max) +
        cos_theta * safe_sqrt(1 - sin2_theta / sin2_max); // at the centre, from the reference's side
    float sin_alpha = safe_sqrt(1 - sqr(cos_alpha));
    float sin_theta = std::sqrt(sin2_theta);
    vec2 around = sin_theta > 0 ? vec2(local) / sin_theta : vec2(1, 0);
    Basis frame = Basis::from_normal(to_center / std::sqrt(distance2));
    n = frame.to_world({around * sin_alpha, -cos_alpha});
    density = uniform_cone_pdf(one_minus_cos_max);
  } else {
    if (!two_sided) return std::nullopt;
    n = sample_uniform_sphere(u);
    density = solid_angle_density(ref, center + radius * n, n, 4 * kPi * radius2, true);
    if (!(density > 0)) return std::nullopt;
  }
  n = glm::normalize(n);
  vec3 offset = radius * n;
  return towards(ref, center + offset, gamma_bound(6) * (glm::abs(center) + glm::abs(offset)), n, emission,
                 density);
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
  return towards(ref, p, gamma_bound(6) * (glm::abs(center) + radius), normal, emission, density);
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
  LightSample s = towards(ref, position, vec3(0), vec3(0), intensity / divisor, 1);
  s.delta = true;
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
  vec3 local = sample_cosine_hemisphere(u);
  if (!(local.z > 0)) return std::nullopt;
  LightSample s;
  s.direction = Basis::from_normal(ref.normal).to_world(local);
  s.radiance = radiance;
  s.pdf = pdf(ref, {}, s.direction);
  s.infinite = true;
  if (!(s.pdf > 0)) return std::nullopt;
  return s;
}

std::optional<LightSample> EnvironmentLight::sample(const LightReference& ref, vec2 u) const {
  auto local = map->sample(u);
  if (!local) return std::nullopt;
  LightSample s;
  s.direction = world_from_map * *local;
  s.radiance = radiance_from(s.direction);
  s.pdf = pdf(ref, {}, s.direction);
  s.infinite = true;
  if (!(s.pdf > 0)) return std::nullopt;
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
    float operator()(const RectangleLight& l) const { return area(l.emission, l.area, l.two_sided); }
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
