#include "render/lights/light_lanes.h"

namespace candela {

namespace {

/// Samples of rectangles, until there are enough to fill the vector unit.
class RectangleQueue {
public:
  void push(const LightQuery& query, LightSampleLanes& samples) {
    const RectangleLight& light = std::get<RectangleLight>(*query.light);
    if (!faces(*query.context, light.corner, light.normal, light.two_sided)) {
      samples.set(query.lane, std::nullopt);
      return;
    }
    if (light.picture != nullptr) {
      samples.set(query.lane, light.sample(*query.context, query.u));
      return;
    }
    vec3 d = light.corner - query.context->position;
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
      RectangleLight::Point p =
          light.point(*query.context, query.u, place, static_cast<float>(batch_.solid_angle[n]));
      const std::size_t i = query.lane;
      samples.set_area(i, p.pdf, p.position, light.point_error, light.normal, light.emission);
    }
  }

private:
  static_assert(RectangleBatch::kSize >= kLaneCount);
  RectangleBatch batch_;
  Lanes<const LightQuery*> queries_;
};

/// Spheres that are seen from outside.
struct SphereLanes {
  Vec3Lanes center, to_center;
  Lanes<float> radius, u, v;
  Vec3Lanes normal, point, error; ///< what comes of it
  Lanes<float> pdf;
};
[[gnu::noinline]] void sample_spheres(SphereLanes& s, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    vec3 center = s.center[i];
    float radius = s.radius[i];
    SphereLight::Point p = SphereLight::point_towards(s.to_center[i], radius, {s.u[i], s.v[i]});
    vec3 offset = radius * p.normal;
    s.normal.set(i, p.normal);
    s.point.set(i, center + offset);
    s.error.set(i, SphereLight::point_error(center, offset));
    s.pdf[i] = p.pdf;
  }
}

/// The same for spheres, those seen from inside and those with pictures apart.
class SphereQueue {
public:
  void push(const LightQuery& query, LightSampleLanes& samples) {
    const SphereLight& light = std::get<SphereLight>(*query.light);
    vec3 to_center = light.center - query.context->position;
    if (!(length_squared(to_center) > sqr(light.radius)) || light.picture != nullptr) {
      samples.set(query.lane, light.sample(*query.context, query.u));
      return;
    }
    const std::size_t n = count_++;
    queries_[n] = &query;
    lanes_.center.set(n, light.center);
    lanes_.to_center.set(n, to_center);
    lanes_.radius[n] = light.radius;
    lanes_.u[n] = query.u.x, lanes_.v[n] = query.u.y;
  }

  void sample(LightSampleLanes& samples) {
    sample_spheres(lanes_, count_);
    for (std::size_t n = 0; n < count_; ++n)
      samples.set_area(queries_[n]->lane, lanes_.pdf[n], lanes_.point[n], lanes_.error[n], lanes_.normal[n],
                       std::get<SphereLight>(*queries_[n]->light).emission);
  }

private:
  std::size_t count_ = 0;
  SphereLanes lanes_;
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

void LightSampleLanes::set_area(std::size_t i, float density, vec3 place, vec3 error, vec3 normal,
                                Spectrum emission) {
  pdf[i] = density;
  point.set(i, place);
  point_error.set(i, error);
  point_normal.set(i, normal);
  radiance.set(i, emission);
  infinite[i] = 0;
  delta[i] = false;
}

void sample_lights(std::span<const LightQuery> queries, LightSampleLanes& samples) {
  // Only these two are vectorised; all others are sampled one by one.
  RectangleQueue rectangles;
  SphereQueue spheres;
  for (const LightQuery& query : queries)
    if (std::holds_alternative<RectangleLight>(*query.light))
      rectangles.push(query, samples);
    else if (std::holds_alternative<SphereLight>(*query.light))
      spheres.push(query, samples);
    else
      samples.set(query.lane, sample_light(*query.light, *query.context, query.u));
  rectangles.sample(samples);
  spheres.sample(samples);
}

} // namespace candela
