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

vec3 place_on(const RectangleLight& light, float x, float y) {
  return light.corner + x * light.axis_x + y * light.axis_y;
}

/// A place on the light and its density in 1/sr, which is 0 if there is none.
struct RectanglePoint {
  vec3 position;
  float pdf;
};
/// At `place`, along the edges, if the light covers enough of the sphere; else by area.
[[gnu::always_inline]] inline RectanglePoint point_on(const RectangleLight& light, const LightReference& ref,
                                                      vec2 u, vec2 place, float solid_angle) {
  if (solid_angle >= SphericalRectangle::kMinSolidAngle)
    return {place_on(light, place.x, place.y), 1 / solid_angle};
  vec3 p = place_on(light, u.x * light.length_x, u.y * light.length_y);
  return {p, solid_angle_density(ref, p, light.normal, light.area(), light.two_sided)};
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

namespace {

/// Samples of rectangles, until there are enough to fill the vector unit.
class RectangleQueue {
public:
  void push(const LightQuery& query, LightSampleLanes& samples) {
    const RectangleLight& light = std::get<RectangleLight>(*query.light);
    if (!faces(*query.reference, light.corner, light.normal, light.two_sided)) {
      samples.set(query.lane, std::nullopt);
      return;
    }
    vec3 d = light.corner - query.reference->position;
    const std::size_t n = batch_.count++;
    queries_[n] = &query;
    auto wide = [](float value) { return static_cast<double>(value); };
    batch_.x0[n] = wide(glm::dot(d, light.axis_x)), batch_.y0[n] = wide(glm::dot(d, light.axis_y));
    batch_.z[n] = wide(std::abs(glm::dot(d, light.normal)));
    batch_.length_x[n] = wide(light.length_x), batch_.length_y[n] = wide(light.length_y);
    batch_.u[n] = wide(query.u.x), batch_.v[n] = wide(query.u.y);
  }

  void sample(LightSampleLanes& samples) {
    sample_rectangles(batch_);
    for (std::size_t n = 0; n < batch_.count; ++n) {
      const LightQuery& query = *queries_[n];
      const RectangleLight& light = std::get<RectangleLight>(*query.light);
      const vec2 place(static_cast<float>(batch_.x[n]), static_cast<float>(batch_.y[n]));
      RectanglePoint p =
          point_on(light, *query.reference, query.u, place, static_cast<float>(batch_.solid_angle[n]));
      const std::size_t i = query.lane;
      samples.pdf[i] = p.pdf;
      samples.point.set(i, p.position);
      samples.point_error.set(i, light.point_error);
      samples.point_normal.set(i, light.normal);
      samples.radiance.set(i, light.emission);
      samples.infinite[i] = 0;
      samples.delta[i] = false;
    }
  }

private:
  static_assert(RectangleBatch::kSize >= kLaneCount);
  RectangleBatch batch_;
  Lanes<const LightQuery*> queries_;
};

} // namespace

void LightSampleLanes::set(std::size_t i, const std::optional<LightSample>& sample) {
  infinite[i] = 0;
  pdf[i] = sample ? sample->pdf : 0;
  if (!sample) return;
  point.set(i, sample->point);
  point_error.set(i, sample->point_error);
  point_normal.set(i, sample->point_normal);
  direction.set(i, sample->direction);
  radiance.set(i, sample->radiance);
  infinite[i] = sample->infinite ? 1 : 0;
  delta[i] = sample->delta;
}

void sample_lights(std::span<const LightQuery> queries, LightSampleLanes& samples) {
  RectangleQueue rectangles;
  for (const LightQuery& query : queries)
    if (std::holds_alternative<RectangleLight>(*query.light))
      rectangles.push(query, samples);
    else
      samples.set(query.lane, sample_light(*query.light, *query.reference, query.u));
  rectangles.sample(samples);
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
  std::optional<LightSample> s;
  set_towards(s.emplace(), ref, center + offset, gamma_bound(6) * (glm::abs(center) + glm::abs(offset)), n,
              emission, density);
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
  vec3 local = sample_cosine_hemisphere(u);
  if (!(local.z > 0)) return std::nullopt;
  LightSample s;
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
