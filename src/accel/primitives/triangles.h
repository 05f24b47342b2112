#pragma once
// Triangles with a watertight test. They are most of what rays hit, so the traversal and the packets of rays
// name them: all other kinds go through their intersect().

#include "accel/primitives/pack.h"

#include <glm/gtc/type_ptr.hpp>

namespace candela {

/// vertex[k][axis] of eight triangles.
struct alignas(64) TrianglePack {
  std::array<std::array<std::array<float, kWidth>, 3>, 3> vertex;
  std::array<std::uint32_t, kWidth> primitive;

  static TrianglePack unused() {
    constexpr std::array<std::array<float, kWidth>, 3> kVertex{kNowhere, kNowhere, kNowhere};
    return {{kVertex, kVertex, kVertex}, {}};
  }
  bool operator==(const TrianglePack&) const = default;
};

namespace primitives {

struct Triangles {
  struct Input {
    std::span<const vec3> vertices = {};
    std::span<const uvec3> triangles = {}; ///< three indices into vertices each
  };
  using Pack = TrianglePack;
  static constexpr std::uint32_t kLeafCapacity = kWidth;
  static constexpr float kLeafCost = 1;

  static std::size_t count(const Input& input) { return input.triangles.size(); }

  static Bounds3 bounds(const Input& input, std::size_t i) {
    using accel_detail::usable;
    Bounds3 b;
    uvec3 t = input.triangles[i];
    std::size_t n = input.vertices.size();
    if (t.x >= n || t.y >= n || t.z >= n) return b;
    vec3 p0 = input.vertices[t.x], p1 = input.vertices[t.y], p2 = input.vertices[t.z];
    if (!usable(p0) || !usable(p1) || !usable(p2) || !has_area(p0, p1, p2)) return b;
    b.grow(p0), b.grow(p1), b.grow(p2);
    return b;
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    accel_detail::fill_lanes(pack, primitives, [&](std::size_t lane, std::uint32_t i) {
      for (int k = 0; k < 3; ++k)
        accel_detail::set_axes(pack.vertex[static_cast<std::size_t>(k)], lane,
                               input.vertices[input.triangles[i][k]]);
    });
  }

  /// The boxes of what lies below and above a plane across an axis: calls below(lower, upper corner) and
  /// above(...) for each piece. What rounding may have cut off is added.
  template <class Below, class Above>
  static void cut(const Input& input, std::uint32_t i, std::size_t axis, float plane, Below below,
                  Above above) {
    using simd::Vec4;
    const int a = static_cast<int>(axis);
    const uvec3 t = input.triangles[i];
    std::array<Vec4, 3> p;
    for (int k = 0; k < 3; ++k) {
      const vec3 v = input.vertices[t[k]];
      p[static_cast<std::size_t>(k)] = Vec4{v.x, v.y, v.z, 0};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec4 v = p[k], w = p[(k + 1) % 3];
      if (v[a] <= plane) below(v, v);
      if (v[a] >= plane) above(v, v);
      if ((v[a] < plane) == (w[a] < plane) || v[a] == plane || w[a] == plane) continue;
      Vec4 c = v + (w - v) * ((plane - v[a]) / (w[a] - v[a]));
      // Rounding comes to 12 eps (2^-24) of the greater at most: 5 of w - v, which may be twice that, 1 of
      // c, and 1 of c -+ pad.
      Vec4 pad = simd::max4(simd::abs4(v), simd::abs4(w)) * 0x1p-20f;
      c[a] = plane, pad[a] = 0;
      below(c - pad, c + pad);
      above(c - pad, c + pad);
    }
  }

private:
  /// No ray can be said to hit a triangle without a normal. Exact for all but extreme vertices.
  static bool has_area(vec3 a, vec3 b, vec3 c) {
    glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    return n != glm::dvec3(0);
  }
};

} // namespace primitives

namespace accel_detail {

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

/// Where a line hits eight triangles, or eight lines hit one.
template <class F>
struct TriangleHits {
  simd::LaneMask lanes; ///< that hit; all else says something of these only
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

} // namespace accel_detail

} // namespace candela
