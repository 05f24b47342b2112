#pragma once
// The possible and certain hits of a ray, by testing every primitive in double precision. Within rounding of
// an edge a ray may hit or miss: such hits are possible, others certain.

#include "accel/accel.h"
#include "core/hash.h"

#include <gtest/gtest.h>

#include <vector>

namespace candela::test {

/// Numbers for building random scenes.
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint32_t bits() { return static_cast<std::uint32_t>(hash64(state_ += 0x9e3779b97f4a7c15ull) >> 32); }
  float uniform() { return to_unit_float(bits()); }
  float uniform(float lo, float hi) { return lo + (hi - lo) * uniform(); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(std::uint64_t{bits()} * n >> 32); }
  vec3 in_cube(float half = 1) {
    float x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }
  vec3 direction() {
    for (;;) {
      vec3 v = in_cube();
      if (float l = glm::length(v); l > 0.01f && l < 1) return v / l;
    }
  }

private:
  std::uint64_t state_;
};

/// Owns what an AccelInput refers to.
struct TestScene {
  std::vector<vec3> vertices;
  std::vector<uvec3> triangles;
  std::vector<SphereGeometry> spheres;
  std::vector<DiscGeometry> discs;
  std::vector<InstanceGeometry> instances;
  std::vector<const TestScene*> objects; ///< what the instances show

  AccelInput input() const {
    AccelInput all;
    all.vertices = vertices, all.triangles = triangles;
    all.spheres = spheres, all.discs = discs, all.instances = instances;
    return all;
  }
  void add_triangle(vec3 a, vec3 b, vec3 c) {
    auto i = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.push_back({i, i + 1, i + 2});
  }
};

struct Candidate {
  double t, t_error;
  bool certain;
  std::uint32_t primitive, instance;
  PrimitiveKind kind;
  glm::dvec2 uv; ///< barycentrics of triangles
};

struct DoubleRay {
  glm::dvec3 origin, direction;
};

/// How far, in space, rounding may move things that are `reach` away: 16 roundings of single precision.
inline double rounding(double reach) { return reach * 16 * 0x1p-24; }

inline void triangle_candidate(const TestScene& scene, std::uint32_t i, const DoubleRay& ray, double slack,
                               std::vector<Candidate>& result) {
  uvec3 t = scene.triangles[i];
  std::array<glm::dvec3, 3> p{scene.vertices[t.x], scene.vertices[t.y], scene.vertices[t.z]};
  glm::dvec3 d = glm::normalize(ray.direction);
  // In the plane across the ray: signed distances to the edges.
  glm::dvec3 side = glm::normalize(std::abs(d.x) < 0.5 ? glm::cross(d, glm::dvec3(1, 0, 0))
                                                       : glm::cross(d, glm::dvec3(0, 1, 0)));
  glm::dvec3 up = glm::cross(d, side);
  std::array<glm::dvec2, 3> q;
  for (std::size_t k = 0; k < 3; ++k)
    q[k] = {glm::dot(p[k] - ray.origin, side), glm::dot(p[k] - ray.origin, up)};
  glm::dvec3 edge;
  double distance = 1e300;
  for (int k = 0; k < 3; ++k) {
    glm::dvec2 a = q[static_cast<std::size_t>((k + 1) % 3)], b = q[static_cast<std::size_t>((k + 2) % 3)];
    edge[k] = a.x * b.y - a.y * b.x;
  }
  double area = edge.x + edge.y + edge.z;
  if (area == 0) return;
  double sign = area > 0 ? 1 : -1;
  for (int k = 0; k < 3; ++k) {
    glm::dvec2 a = q[static_cast<std::size_t>((k + 1) % 3)], b = q[static_cast<std::size_t>((k + 2) % 3)];
    distance = std::min(distance, sign * edge[k] / std::max(glm::length(b - a), 1e-300));
  }
  if (distance < -slack) return;
  glm::dvec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
  double cosine = std::abs(glm::dot(n, d));
  double along = glm::dot(p[0] - ray.origin, n) / glm::dot(d, n);
  double scale = 1 / glm::length(ray.direction);
  // Nearly edge on, t is anywhere within the triangle's length.
  double length = std::max(glm::length(p[1] - p[0]), glm::length(p[2] - p[0]));
  bool edge_on = cosine * length < 1e3 * slack;
  double error = edge_on ? 1e3 * length + slack : slack / cosine;
  result.push_back({along * scale,
                    error * scale,
                    distance > slack && !edge_on,
                    i,
                    kNoInstance,
                    PrimitiveKind::triangle,
                    {edge.y / area, edge.z / area}});
}

inline void sphere_candidates(const TestScene& scene, std::uint32_t i, const DoubleRay& ray, double slack,
                              std::vector<Candidate>& result) {
  const SphereGeometry& s = scene.spheres[i];
  double scale = 1 / glm::length(ray.direction), r = s.radius;
  glm::dvec3 d = ray.direction * scale, f = glm::dvec3(s.center) - ray.origin;
  double along = glm::dot(f, d), off = glm::length(f - along * d);
  if (off > r + slack) return;
  bool certain = off < r - slack;
  double half = std::sqrt(std::max(r * r - off * off, 0.0));
  double error = certain ? slack * (1 + r / half) : 2 * std::sqrt(2 * r * slack) + slack;
  for (double t : {along - half, along + half})
    result.push_back({t * scale, error * scale, certain, i, kNoInstance, PrimitiveKind::sphere, {}});
}

inline void disc_candidate(const TestScene& scene, std::uint32_t i, const DoubleRay& ray, double slack,
                           std::vector<Candidate>& result) {
  const DiscGeometry& disc = scene.discs[i];
  double scale = 1 / glm::length(ray.direction);
  glm::dvec3 d = ray.direction * scale, f = glm::dvec3(disc.center) - ray.origin, n = disc.normal;
  double cosine = std::abs(glm::dot(d, n)), along = glm::dot(f, n) / glm::dot(d, n), error = slack / cosine;
  double off = glm::length(d * along - f);
  if (off > disc.radius + error) return;
  result.push_back(
      {along * scale, error * scale, off < disc.radius - error, i, kNoInstance, PrimitiveKind::disc, {}});
}

/// Along the whole line, both ways.
inline std::vector<Candidate> candidates(const TestScene& scene, const DoubleRay& ray) {
  double reach = glm::length(ray.origin);
  for (vec3 p : scene.vertices) reach = std::max(reach, glm::length(glm::dvec3(p) - ray.origin));
  for (const auto& s : scene.spheres)
    reach = std::max(reach, glm::length(glm::dvec3(s.center) - ray.origin) + s.radius);
  for (const auto& s : scene.discs)
    reach = std::max(reach, glm::length(glm::dvec3(s.center) - ray.origin) + s.radius);
  double slack = rounding(reach);
  std::vector<Candidate> result;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) triangle_candidate(scene, i, ray, slack, result);
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) sphere_candidates(scene, i, ray, slack, result);
  for (std::uint32_t i = 0; i < scene.discs.size(); ++i) disc_candidate(scene, i, ray, slack, result);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    glm::dmat4 inverse = glm::inverse(glm::dmat4(scene.instances[i].world_from_object));
    DoubleRay local{inverse * glm::dvec4(ray.origin, 1), inverse * glm::dvec4(ray.direction, 0)};
    for (Candidate c : candidates(*scene.objects[i], local)) {
      c.instance = i;
      c.t_error *= 4; // the transform rounds too
      result.push_back(c);
    }
  }
  return result;
}

struct RayCount {
  int hits = 0, certain_hits = 0, misses = 0;
};

/// Checks the closest hit and the any-hit answer against all candidates.
inline void check_ray(const TestScene& scene, const Accel& accel, const Ray& ray, RayCount& count) {
  auto hit = accel.intersect(ray);
  ASSERT_EQ(accel.occluded(ray), hit.has_value());
  ++(hit ? count.hits : count.misses);
  bool found = false;
  for (const Candidate& c : candidates(scene, {ray.origin, ray.direction})) {
    bool in_range = c.t - c.t_error > ray.t_min && c.t + c.t_error < ray.t_max;
    if (c.certain && in_range) {
      ++count.certain_hits;
      ASSERT_TRUE(hit) << "missed primitive " << c.primitive << " at t = " << c.t;
      ASSERT_LE(hit->t, c.t + c.t_error)
          << "primitive " << c.primitive << " is closer than " << hit->primitive;
    }
    if (hit && c.primitive == hit->primitive && c.kind == hit->kind && c.instance == hit->instance &&
        std::abs(c.t - hit->t) <= c.t_error) {
      found = true;
      if (c.certain && c.kind == PrimitiveKind::triangle) {
        ASSERT_NEAR(hit->u, c.uv.x, 2e-2);
        ASSERT_NEAR(hit->v, c.uv.y, 2e-2);
      }
    }
  }
  if (!hit) return;
  ASSERT_TRUE(found) << "no such hit: primitive " << hit->primitive << ", instance " << hit->instance
                     << ", t " << hit->t;
  ASSERT_GT(hit->t, ray.t_min);
  ASSERT_LT(hit->t, ray.t_max);
  if (hit->kind == PrimitiveKind::triangle) {
    ASSERT_GE(hit->u, 0);
    ASSERT_GE(hit->v, 0);
    ASSERT_LE(hit->u + hit->v, 1 + 1e-6f);
  } else {
    ASSERT_EQ(hit->u, 0);
    ASSERT_EQ(hit->v, 0);
  }
}

} // namespace candela::test
