#pragma once
// Closed forms of irradiances in double precision, independent of the tested code.

#include "core/math.h"

#include <span>
#include <vector>

namespace candela::test {

using glm::dvec3;
inline constexpr double kPiD = std::numbers::pi;

/// Irradiance at p (unit normal n) from a polygon of radiance 1 that is wholly above p's horizon:
///     E = 1/2 sum_i theta_i n . gamma_i,
/// theta_i being the angle that edge i subtends and gamma_i the unit normal of the plane through p and the
/// edge (Lambert 1760; Baum, Rushmeier & Winget 1989, "Improving Radiosity Solutions", eq. 5).
inline double polygon_irradiance(dvec3 p, dvec3 n, std::span<const dvec3> corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    dvec3 a = glm::normalize(corners[i] - p), b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    dvec3 c = glm::cross(a, b);
    double sine = glm::length(c);
    if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(n, c / sine);
  }
  return 0.5 * std::abs(sum);
}

/// Configuration factor of an element facing a rectangle a x b at distance c whose corner is on its normal
/// (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3); irradiance = pi L F.
inline double parallel_rectangle_factor(double a, double b, double c) {
  double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPiD);
}

/// Of an element whose plane is perpendicular to the rectangle: b wide along the line in which the two planes
/// meet, a high from that line, the element c from the corner that lies on the line (Howell, B-4).
inline double perpendicular_rectangle_factor(double a, double b, double c) {
  double x = a / b, y = c / b, r = std::sqrt(x * x + y * y);
  return (std::atan(1 / y) - y / r * std::atan(1 / r)) / (2 * kPiD);
}

/// Irradiance of a disc of radiance 1 on a parallel element on its axis (Howell, B-12 with the element on the
/// axis).
inline double disc_irradiance(double radius, double distance) {
  return kPiD * radius * radius / (radius * radius + distance * distance);
}

/// Irradiance of a sphere of radiance 1 that is wholly above the horizon, its centre at `cosine` to the
/// normal (Howell, B-16).
inline double sphere_irradiance(double radius, double distance, double cosine) {
  return kPiD * radius * radius / (distance * distance) * cosine;
}

/// Reflectance of a smooth dielectric at normal incidence (Fresnel).
inline double normal_reflectance(double ior) { return (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)); }

/// A slab of thickness d seen along its normal, all internal reflections summed as geometric series, with the
/// single-pass transmittance a = exp(-sigma d) and the reflectance r of either face (Stokes 1862).
inline double slab_transmission(double r, double a) { return (1 - r) * (1 - r) * a / (1 - r * r * a * a); }
inline double slab_reflection(double r, double a) {
  return r + (1 - r) * (1 - r) * r * a * a / (1 - r * r * a * a);
}

} // namespace candela::test
