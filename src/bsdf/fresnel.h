#pragma once
// Reflectance of smooth interfaces, and refraction.

#include "core/spectrum.h"

#include <optional>

namespace candela {

/// Share of unpolarised light that a smooth dielectric reflects: the mean of the Fresnel equations for both
/// polarisations. cos_theta_i >= 0 is on the incident side; eta is the refractive index of the far side over
/// that of the incident side. 1 under total internal reflection.
inline float fresnel_dielectric(float cos_theta_i, float eta) {
  float sin2_theta_t = (1 - sqr(cos_theta_i)) / sqr(eta); // Snell
  if (sin2_theta_t >= 1) return 1;
  float cos_theta_t = safe_sqrt(1 - sin2_theta_t);
  float r_parallel = (eta * cos_theta_i - cos_theta_t) / (eta * cos_theta_i + cos_theta_t);
  float r_perpendicular = (cos_theta_i - eta * cos_theta_t) / (cos_theta_i + eta * cos_theta_t);
  return 0.5f * (sqr(r_parallel) + sqr(r_perpendicular));
}

/// Where light seen along wo (unit, away from the surface, local frame) comes from on the other side of the
/// surface; nothing under total internal reflection. eta as above, wo being on the incident side.
inline std::optional<vec3> refract(vec3 wo, float eta) {
  float inv_eta = 1 / eta;
  float sin2_theta_t = sqr(inv_eta) * (sqr(wo.x) + sqr(wo.y));
  if (sin2_theta_t >= 1) return std::nullopt;
  float cos_theta_t = safe_sqrt(1 - sin2_theta_t);
  return vec3(-wo.x * inv_eta, -wo.y * inv_eta, -std::copysign(cos_theta_t, wo.z));
}

/// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", eq. 15; f0 is the reflectance at
/// normal incidence.
inline Spectrum fresnel_schlick(Spectrum f0, float cos_theta) {
  float m = std::clamp(1 - cos_theta, 0.0f, 1.0f);
  float m5 = sqr(sqr(m)) * m;
  return f0 + (Spectrum(1) - f0) * m5;
}

} // namespace candela
