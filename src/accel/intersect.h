#pragma once
// Eight primitives against one ray. Each kernel gives the lanes that are hit with t in (t_min, t_max) and
// their t.

#include "accel/layout.h"

#include <glm/gtc/type_ptr.hpp>

#include <tuple>

namespace candela::accel_detail {

/// What a kernel finds: lanes, and their t in memory, because single lanes are read next.
struct LaneHits {
  simd::LaneMask lanes = 0;
  alignas(32) std::array<float, kWidth> t;
};

/// The lane of least t among some; of those that share it, one with the lowest primitive.
inline std::size_t closest_lane(simd::LaneMask lanes, const std::array<float, kWidth>& t,
                                const std::array<std::uint32_t, kWidth>& primitive) {
  auto best = static_cast<std::size_t>(std::countr_zero(lanes));
  simd::for_each_lane(lanes & (lanes - 1), [&](int lane) {
    auto i = static_cast<std::size_t>(lane);
    if (t[i] < t[best] || (t[i] == t[best] && primitive[i] < primitive[best])) best = i;
  });
  return best;
}

/// Of hits at the same t one has to be chosen, and in a way that does not depend on the order in which a ray
/// comes to them: then the company that a ray travels in does not show in the image. This is asked where a
/// hit is as far as the closest one so far, `found`, whose t is NaN where there is none.
inline bool precedes(const Hit& hit, const Hit& found) {
  return std::tie(hit.instance, hit.kind, hit.primitive) <
         std::tie(found.instance, found.kind, found.primitive);
}

/// The axis of the largest component; the first of several. By arithmetic and from memory: branches on the
/// axis (GLM's operator[] is a switch) would be mispredicted for every other diffuse ray, a tenth of its
/// time.
inline std::size_t largest_axis(const vec3& direction) {
  const float* d = glm::value_ptr(direction);
  float size_x = std::abs(d[0]), size_y = std::abs(d[1]), size_z = std::abs(d[2]);
  std::size_t y_largest = size_y > size_x, z_largest = size_z > std::max(size_x, size_y);
  return std::max(y_largest, 2 * z_largest);
}

/// A ray in a sheared space where it starts at 0 and points along +z (Woop, Benthin and Wald 2013,
/// "Watertight Ray/Triangle Intersection", JCGT 2(1)). There the triangle test is a 2-D point-in-triangle
/// test at the origin, and since both triangles at an edge see the same rounded 2-D vertices, they agree on
/// the edge. One ray in all lanes, or a ray a lane that have kz in common. The winding may turn over, for the
/// test takes both sides.
template <class F>
struct ShearedRay {
  std::size_t kx, ky, kz; ///< kz: the axis of the largest direction component
  F origin_x, origin_y, origin_z;
  F shear_x, shear_y, scale_z;

  ShearedRay(std::size_t x, std::size_t y, std::size_t z, F origin_x_, F origin_y_, F origin_z_, F shear_x_,
             F shear_y_, F scale_z_)
      : kx(x), ky(y), kz(z), origin_x(origin_x_), origin_y(origin_y_), origin_z(origin_z_), shear_x(shear_x_),
        shear_y(shear_y_), scale_z(scale_z_) {}

  explicit ShearedRay(const Ray& ray) {
    const float* o = glm::value_ptr(ray.origin);
    const float* d = glm::value_ptr(ray.direction);
    kz = largest_axis(ray.direction);
    static constexpr std::array<std::size_t, 3> kNext{1, 2, 0}, kNextButOne{2, 0, 1};
    kx = kNext[kz], ky = kNextButOne[kz];
    float inverse_z = 1 / d[kz];
    origin_x = F(o[kx]), origin_y = F(o[ky]), origin_z = F(o[kz]);
    shear_x = F(d[kx] * inverse_z), shear_y = F(d[ky] * inverse_z);
    scale_z = F(inverse_z);
  }
};

/// One triangle of a pack, in all lanes.
struct PackedTriangle {
  const TrianglePack* pack;
  std::size_t lane;
  std::uint32_t primitive;
};

template <class F>
[[gnu::always_inline]] inline F load_vertex(const TrianglePack& pack, std::size_t k, std::size_t axis) {
  return F::load(pack.vertex[k][axis].data());
}
template <class F>
[[gnu::always_inline]] inline F load_vertex(const PackedTriangle& t, std::size_t k, std::size_t axis) {
  return F(t.pack->vertex[k][axis][t.lane]);
}

/// The vertices of eight triangles in the ray's sheared space, or of a triangle in those of eight rays.
template <class F>
struct ShearedTriangles {
  std::array<F, 3> x, y, z;

  template <class Triangles>
  [[gnu::always_inline]] ShearedTriangles(const Triangles& triangles, const ShearedRay<F>& ray) {
    for (std::size_t k = 0; k < 3; ++k) {
      z[k] = load_vertex<F>(triangles, k, ray.kz) - ray.origin_z;
      x[k] = (load_vertex<F>(triangles, k, ray.kx) - ray.origin_x) - ray.shear_x * z[k];
      y[k] = (load_vertex<F>(triangles, k, ray.ky) - ray.origin_y) - ray.shear_y * z[k];
    }
  }
};

/// Twice the signed areas between the origin and the edges opposite to vertices 0, 1 and 2.
template <class F>
struct EdgeFunctions {
  F u, v, w;

  [[gnu::always_inline]] explicit EdgeFunctions(const ShearedTriangles<F>& p)
      : u(p.x[2] * p.y[1] - p.y[2] * p.x[1]), v(p.x[0] * p.y[2] - p.y[0] * p.x[2]),
        w(p.x[1] * p.y[0] - p.y[1] * p.x[0]) {}
};

struct ResolvedEdges {
  simd::LaneMask lanes;
  alignas(32) std::array<float, kWidth> u, v, w;
};

/// The edge functions again in double precision, for the lanes where one of them is 0 in single precision:
/// the product of two floats is exact in double, so the sign is that of the exact value and 0 means on the
/// edge. Gives the lanes that stay hit. Out of line and from scratch, or the common case would store its
/// vertices.
template <class F, class Triangles>
[[gnu::noinline, gnu::cold]] ResolvedEdges resolve_edges(const Triangles& triangles, const ShearedRay<F>& ray,
                                                         simd::LaneMask lanes) {
  ShearedTriangles<F> p(triangles, ray);
  EdgeFunctions<F> e(p);
  alignas(32) float x[3][kWidth], y[3][kWidth];
  for (std::size_t k = 0; k < 3; ++k) p.x[k].store(x[k]), p.y[k].store(y[k]);
  ResolvedEdges result;
  result.lanes = 0;
  e.u.store(result.u.data()), e.v.store(result.v.data()), e.w.store(result.w.data());
  simd::for_each_lane(lanes, [&](int i) {
    auto edge = [&](int a, int b) {
      return static_cast<double>(x[a][i]) * y[b][i] - static_cast<double>(y[a][i]) * x[b][i];
    };
    double u = edge(2, 1), v = edge(0, 2), w = edge(1, 0);
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return;
    auto lane = static_cast<std::size_t>(i);
    result.u[lane] = static_cast<float>(u);
    result.v[lane] = static_cast<float>(v);
    result.w[lane] = static_cast<float>(w);
    result.lanes |= 1u << i;
  });
  return result;
}

/// Where a line meets eight triangles, or eight lines meet one.
template <class F>
struct TriangleHits {
  simd::LaneMask lanes; ///< that meet; all else says something of these only
  EdgeFunctions<F> edge;
  F determinant, t; ///< infinite or NaN where the triangle is seen edge-on

  template <class Triangles>
  [[gnu::always_inline]] TriangleHits(const Triangles& triangles, const ShearedRay<F>& ray)
      : TriangleHits(triangles, ray, ShearedTriangles<F>(triangles, ray)) {}

private:
  template <class Triangles>
  [[gnu::always_inline]] TriangleHits(const Triangles& triangles, const ShearedRay<F>& ray,
                                      const ShearedTriangles<F>& p)
      : edge(p) {
    // Inside if no two signs differ. Rounding is monotonic, so the sign of a difference of two rounded
    // products is right unless it is 0; and a 0 can matter only where the other two signs agree, that is,
    // where it is the least or the greatest of the three.
    F zero(0.0f), least = min(edge.u, min(edge.v, edge.w)), greatest = max(edge.u, max(edge.v, edge.w));
    lanes = less_equal(zero, least) | less_equal(greatest, zero);
    if (!lanes) return;
    if (simd::LaneMask on_edge = lanes & (equal(least, zero) | equal(greatest, zero))) [[unlikely]] {
      ResolvedEdges resolved = resolve_edges(triangles, ray, on_edge);
      lanes = (lanes & ~on_edge) | resolved.lanes;
      edge.u = F::load(resolved.u.data()), edge.v = F::load(resolved.v.data());
      edge.w = F::load(resolved.w.data());
    }
    // t = (u z0 + v z1 + w z2) / (u + v + w)
    determinant = edge.u + edge.v + edge.w;
    t = (edge.u * p.z[0] + edge.v * p.z[1] + edge.w * p.z[2]) * ray.scale_z / determinant;
  }
};

/// Whether a triangle is hit with t in (t_min, t_max). For the closest hit, sets hit and lowers t_max to its
/// t; at the t of the hit so far, if the triangle precedes.
template <class F, bool any_hit>
[[gnu::always_inline]] inline bool meet_triangles(const TrianglePack& pack, const ShearedRay<F>& ray,
                                                  float t_min, float& t_max, Hit& hit) {
  const TriangleHits<F> found(pack, ray);
  if (!found.lanes) return false;
  simd::LaneMask closer = found.lanes & less(F(t_min), found.t) & less(found.t, F(t_max));
  if constexpr (any_hit) return closer;
  if (!closer) {
    closer = found.lanes & equal(found.t, F(hit.t));
    if (!closer) [[likely]]
      return false;
  }

  auto i = static_cast<std::size_t>(std::countr_zero(closer));
  float closest = first_lane(found.t, closer);
  if (closer & (closer - 1)) [[unlikely]] {
    alignas(32) std::array<float, kWidth> ts;
    found.t.store(ts.data());
    i = closest_lane(closer, ts, pack.primitive);
    closest = ts[i];
  }
  if (closest == hit.t) [[unlikely]] {
    if (!precedes({closest, 0, 0, pack.primitive[i], kNoInstance, PrimitiveKind::triangle}, hit))
      return false;
  }
  t_max = closest;
  alignas(32) std::array<float, kWidth> vs, ws, determinants;
  found.edge.v.store(vs.data()), found.edge.w.store(ws.data());
  found.determinant.store(determinants.data());
  float inverse = 1 / determinants[i];
  hit = {closest, vs[i] * inverse, ws[i] * inverse, pack.primitive[i], kNoInstance, PrimitiveKind::triangle};
  return true;
}

/// Both roots without cancellation, also for small and far spheres (Haines et al. 2019, "Precision
/// Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7): the discriminant from the
/// distance between centre and line, the smaller root from the product of the roots.
template <class F>
inline void intersect_spheres(const SpherePack& pack, const Ray& ray, float t_min, float t_max,
                              LaneHits& hits) {
  std::array<F, 3> d, f;
  for (std::size_t i = 0; i < 3; ++i) {
    int axis = static_cast<int>(i);
    d[i] = F(ray.direction[axis]);
    f[i] = F::load(pack.center[i].data()) - F(ray.origin[axis]);
  }
  auto dot = [](const std::array<F, 3>& a, const std::array<F, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  F a = dot(d, d), b = dot(f, d), radius = F::load(pack.radius.data()), along = b / a;
  std::array<F, 3> perpendicular{f[0] - along * d[0], f[1] - along * d[1], f[2] - along * d[2]};
  F discriminant = radius * radius - dot(perpendicular, perpendicular);
  hits.lanes = less_equal(F(0.0f), discriminant);
  if (!hits.lanes) return;
  F distance2 = dot(f, f), radius2 = radius * radius;
  F q = b + with_sign_of(sqrt(a * max(discriminant, F(0.0f))), b);
  F t0 = (distance2 - radius2) / q, t1 = q / a;
  F first = min(t0, t1), second = max(t0, t1);
  // From inside, or with the first hit before t_min, the second one counts.
  F t = select_less(F(t_min), first, first, second);
  hits.lanes &= less(F(t_min), t) & less(t, F(t_max));
  t.store(hits.t.data());
}

template <class F>
inline void intersect_discs(const DiscPack& pack, const Ray& ray, float t_min, float t_max, LaneHits& hits) {
  std::array<F, 3> d, f, n;
  for (std::size_t i = 0; i < 3; ++i) {
    int axis = static_cast<int>(i);
    d[i] = F(ray.direction[axis]);
    f[i] = F::load(pack.center[i].data()) - F(ray.origin[axis]);
    n[i] = F::load(pack.normal[i].data());
  }
  auto dot = [](const std::array<F, 3>& a, const std::array<F, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  // Parallel to the plane: NaN or infinite, which the range test turns away.
  F t = dot(f, n) / dot(d, n), radius = F::load(pack.radius.data());
  std::array<F, 3> p{t * d[0] - f[0], t * d[1] - f[1], t * d[2] - f[2]};
  hits.lanes = less_equal(dot(p, p), radius * radius) & less(F(t_min), t) & less(t, F(t_max));
  t.store(hits.t.data());
}

} // namespace candela::accel_detail
