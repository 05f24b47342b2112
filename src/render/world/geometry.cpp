#include "render/world/geometry.h"

namespace candela {

SurfaceInteraction Geometry::surface(const Ray& ray, const Hit& hit) const {
  SurfaceInteraction s; // made where the caller wants it: copies of what has just been written by parts stall
  surfaces_.visit(hit, [&](const auto& kind, std::uint64_t first) {
    kind.set_surface(ray, hit, s);
    s.material = kind.material_of(hit);
    s.emitter = first + kind.number_of(hit);
  });
  return s;
}

vec2 Geometry::uv(const Ray& ray, const Hit& hit) const {
  return surfaces_.visit(hit, [&](const auto& kind, std::uint64_t) { return kind.uv(ray, hit); });
}

SurfaceTangents Geometry::tangents(const Ray& ray, const Hit& hit) const {
  return surfaces_.visit(hit, [&](const auto& kind, std::uint64_t) { return kind.tangents(ray, hit); });
}

std::optional<SmoothTriangle> Geometry::smooth_triangle(const Ray& ray, const Hit& hit) const {
  return surfaces_.visit(hit, [&](const auto& kind, std::uint64_t) -> std::optional<SmoothTriangle> {
    if constexpr (requires { kind.smooth_triangle(ray, hit); })
      return kind.smooth_triangle(ray, hit);
    else
      return std::nullopt;
  });
}

std::uint64_t Geometry::number_of(const Hit& hit) const {
  return surfaces_.visit(hit,
                         [&](const auto& kind, std::uint64_t first) { return first + kind.number_of(hit); });
}

std::uint32_t Geometry::triangle_of_instance(const Hit& hit) const {
  return surfaces_.visit(hit, [&](const auto& kind, std::uint64_t) -> std::uint32_t {
    if constexpr (requires { kind.triangle_of_instance(hit); })
      return kind.triangle_of_instance(hit);
    else
      return hit.primitive;
  });
}

std::uint32_t Geometry::other_material_of(const Hit& hit) const {
  return surfaces_.visit(hit, [&](const auto& kind, std::uint64_t) { return kind.material_of(hit); });
}

std::uint32_t Geometry::instance_of(const Hit& hit) const {
  return surfaces_.visit(hit, [&](const auto& kind, std::uint64_t) { return kind.instance_of(hit); });
}

Hit Geometry::hit_at(std::uint64_t emitter, vec3 point) const {
  return surfaces_.visit(
      emitter, [&](const auto& kind, std::uint64_t first) { return kind.hit_at(emitter - first, point); });
}

std::size_t Geometry::memory_bytes() const {
  std::size_t bytes = accel_.memory_bytes();
  surfaces_.for_each([&](const auto& kind, std::uint64_t) { bytes += kind.memory_bytes(); });
  return bytes;
}

} // namespace candela
