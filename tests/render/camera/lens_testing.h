#pragma once
// What the tests of lenses share: an ABCD matrix of their own, and rays.

#include "core/hash.h"
#include "render/camera/lens_system.h"
#include "render/camera/lenses.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {

/// Ray transfer matrix (height, slope times index) from the first vertex to the last, from the scene to the
/// film: Gerrard and Burch 1975, "Introduction to Matrix Methods in Optics".
struct AbcdMatrix {
  double a = 1, b = 0, c = 0, d = 1;

  AbcdMatrix after(const AbcdMatrix& first) const {
    return {a * first.a + b * first.c, a * first.b + b * first.d, c * first.a + d * first.c,
            c * first.b + d * first.d};
  }
  double focal_length() const { return -1 / c; }
  double back_focal_length() const { return -a / c; }  ///< from the last vertex towards the film
  double front_focal_length() const { return -d / c; } ///< from the first vertex towards the scene
};

/// A row of a table in double, for it is changed here.
struct DoubleRow {
  double radius, thickness, eta, diameter;
};

inline std::vector<DoubleRow> rows_of(std::span<const LensInterface> table) {
  auto decimal = [](float x) { return std::round(static_cast<double>(x) * 1e5) / 1e5; }; // as printed
  std::vector<DoubleRow> rows;
  for (const LensInterface& i : table)
    rows.push_back(
        {decimal(i.curvature_radius), decimal(i.thickness), decimal(i.eta), decimal(i.aperture_diameter)});
  return rows;
}

inline AbcdMatrix system_matrix(std::span<const DoubleRow> rows) {
  AbcdMatrix m;
  double before = 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DoubleRow& r = rows[i];
    m = AbcdMatrix{1, 0, r.radius == 0 ? 0 : -(r.eta - before) / r.radius, 1}.after(m);
    if (i + 1 < rows.size()) m = AbcdMatrix{1, r.thickness / r.eta, 0, 1}.after(m);
    before = r.eta;
  }
  return m;
}

inline AbcdMatrix system_matrix(std::span<const LensInterface> table) {
  return system_matrix(rows_of(table));
}

inline LensSystem lens_of(const LensPrescription& lens, float f_stop = 0, float focus = kInfinity,
                          float film_radius = 17.5f) {
  return {lens.interfaces,
          {.focal_length = lens.focal_length,
           .f_stop = f_stop,
           .focus_distance = focus,
           .film_radius = film_radius}};
}

class Uniform {
public:
  explicit Uniform(std::uint64_t stream) : random_(fresh_seed() + stream) {}
  float operator()() { return to_unit_float(static_cast<std::uint32_t>(random_() >> 32)); }
  float operator()(float low, float high) { return low + (high - low) * (*this)(); }
  vec2 point() {
    const float x = (*this)();
    return {x, (*this)()};
  }
  /// Of the disc about the origin.
  vec2 in_disc(float radius) {
    const float r = radius * std::sqrt((*this)()), phi = 2 * kPi * (*this)();
    return {r * std::cos(phi), r * std::sin(phi)};
  }

private:
  std::mt19937_64 random_;
};

inline LensRay ray_between(vec3 from, vec3 to) { return {from, glm::normalize(to - from)}; }

/// From the film to a point of the plane z = 0.
inline LensRay film_ray(const LensSystem& lens, vec2 film, vec2 rear) {
  return ray_between(vec3(film, -lens.film_distance()), vec3(rear, 0));
}

/// Where a ray meets the plane of that z.
inline vec2 at_plane(const LensRay& ray, double z) {
  const double t = (z - static_cast<double>(ray.origin.z)) / static_cast<double>(ray.direction.z);
  return vec2(glm::dvec2(ray.origin) + t * glm::dvec2(ray.direction));
}

/// A ray that starts before the lens, from a point of the axis `distance` before the entrance pupil (it may
/// be infinite) to a point of that pupil.
inline LensRay ray_from_axis(const LensSystem& lens, double distance, vec2 pupil) {
  const double z = lens.entrance_pupil().z;
  if (std::isinf(distance)) return {vec3(pupil, lens.front_vertex() + 100), {0, 0, -1}};
  const glm::dvec3 d = glm::normalize(glm::dvec3(glm::dvec2(pupil), -distance));
  // Begins near the lens, so that floats keep its digits.
  const double way = std::min(distance, lens.front_vertex() - z + 100) / -d.z;
  const glm::dvec3 p = glm::dvec3(glm::dvec2(pupil), z) - way * d;
  return {vec3(p), vec3(d)};
}

} // namespace candela::test
