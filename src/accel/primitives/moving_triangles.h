#pragma once
// Triangles whose vertices move on straight lines while the shutter is open: meshes that deform. At every
// time the test is that of triangles which stand still, and as watertight.

#include "accel/primitives/triangles.h"
#include "accel/simd/simd.h"

namespace candela {

/// Between the values of the times 0 and 1, which it gives exactly.
inline vec3 at_time(vec3 begin, vec3 end, float time) { return (1 - time) * begin + time * end; }

struct alignas(64) MovingTrianglePack {
  using Vertices = std::array<std::array<std::array<float, kWidth>, 3>, 3>; ///< as those of TrianglePack
  Vertices begin, end;                                                      ///< at times 0 and 1
  std::array<std::uint32_t, kWidth> primitive;
  bool operator==(const MovingTrianglePack&) const = default;
};

namespace primitives {

struct MovingTriangles {
  struct Input {
    std::span<const vec3> moving_vertices = {}, moving_vertices_end = {}; ///< at times 0 and 1, as many
    std::span<const uvec3> moving_triangles = {};
  };
  using Pack = MovingTrianglePack;
  static constexpr std::uint32_t kLeafCapacity = kWidth;
  static constexpr float kLeafCost = 2;

  static std::size_t count(const Input& input) { return input.moving_triangles.size(); }

  /// Of all times: a vertex lies between its ends.
  static Bounds3 bounds(const Input& input, std::size_t i) {
    Bounds3 b;
    const uvec3 t = input.moving_triangles[i];
    const std::size_t n = std::min(input.moving_vertices.size(), input.moving_vertices_end.size());
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= n) return {};
      for (const vec3 p : {input.moving_vertices[t[k]], input.moving_vertices_end[t[k]]}) {
        if (!accel_detail::usable(p)) return {};
        b.grow(p);
      }
    }
    return accel_detail::padded(b.center(), 0.5f * b.diagonal());
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    TrianglePack begin, end;
    Triangles::fill(begin, {input.moving_vertices, input.moving_triangles}, primitives);
    Triangles::fill(end, {input.moving_vertices_end, input.moving_triangles}, primitives);
    pack = {begin.vertex, end.vertex, begin.primitive};
  }

  template <class F>
  static void intersect(const Pack& pack, const Ray& ray, float t_min, float t_max,
                        accel_detail::LaneHits& hits) {
    const TrianglePack now = pack_at<F>(pack, ray.time);
    const accel_detail::TriangleHits<F> found(now, accel_detail::ShearedRay<F>(ray));
    hits.lanes = found.lanes;
    if (!hits.lanes) return;
    hits.lanes &= less(F(t_min), found.t) & less(found.t, F(t_max));
    found.t.store(hits.t.data());
  }

  static vec2 parameters(const Pack& pack, std::size_t lane, const Ray& ray, const accel_detail::LaneHits&) {
    using F = simd::Float8;
    const TrianglePack now = pack_at<F>(pack, ray.time);
    const accel_detail::TriangleHits<F> found(now, accel_detail::ShearedRay<F>(ray));
    alignas(32) std::array<float, kWidth> v, w, determinant;
    found.edge.v.store(v.data()), found.edge.w.store(w.data());
    found.determinant.store(determinant.data());
    const float inverse = 1 / determinant[lane];
    return {v[lane] * inverse, w[lane] * inverse};
  }

private:
  /// The triangles as they are at a time, as at_time() has it. Unused lanes stay infinite or become NaN.
  template <class F>
  static TrianglePack pack_at(const Pack& pack, float time) {
    TrianglePack now;
    const F begin(1 - time), end(time);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        (begin * F::load(pack.begin[k][axis].data()) + end * F::load(pack.end[k][axis].data()))
            .store(now.vertex[k][axis].data());
    now.primitive = pack.primitive;
    return now;
  }
};

} // namespace primitives

} // namespace candela
