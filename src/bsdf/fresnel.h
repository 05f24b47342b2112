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

/// What it lets pass, 1 - fresnel_dielectric, of the cosines > 0 on both sides, which Snell's law relates by
/// eta: to all digits where little passes.
inline float fresnel_dielectric_transmittance(float cos_theta_i, float cos_theta_t, float eta) {
  return 2 * eta * cos_theta_i * cos_theta_t *
         (1 / sqr(eta * cos_theta_i + cos_theta_t) + 1 / sqr(cos_theta_i + eta * cos_theta_t));
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

/// The same about the unit normal h of a facet that w sees, for an eta that does not reflect all of it. Unit.
inline vec3 refract_about(vec3 w, vec3 h, float eta) {
  const float cosine = glm::dot(w, h), inv_eta = 1 / eta;
  return (cosine * inv_eta - safe_sqrt(1 - sqr(inv_eta) * (1 - sqr(cosine)))) * h - inv_eta * w;
}

/// Share of unpolarised light that a conductor reflects; its complex refractive index is eta + i k over that
/// of the outside (Born & Wolf, "Principles of Optics", section 14.2).
inline Spectrum fresnel_conductor(float cos_theta, Spectrum eta, Spectrum k) {
  const float cos2 = sqr(std::clamp(cos_theta, 0.0f, 1.0f)), sin2 = 1 - cos2;
  const Spectrum t0 = eta * eta - k * k - sin2;
  const Spectrum a2_b2 = glm::sqrt(t0 * t0 + 4.0f * eta * eta * k * k);
  const Spectrum a = glm::sqrt(glm::max(0.5f * (a2_b2 + t0), Spectrum(0)));
  const Spectrum t1 = a2_b2 + cos2, t2 = 2 * std::sqrt(cos2) * a;
  const Spectrum perpendicular = (t1 - t2) / (t1 + t2);
  const Spectrum t3 = cos2 * a2_b2 + sqr(sin2), t4 = t2 * sin2;
  const Spectrum parallel = perpendicular * (t3 - t4) / (t3 + t4);
  return 0.5f * (perpendicular + parallel);
}

/// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", eq. 15; f0 is the reflectance at
/// normal incidence.
inline Spectrum fresnel_schlick(Spectrum f0, float cos_theta) {
  float m = std::clamp(1 - cos_theta, 0.0f, 1.0f);
  float m5 = sqr(sqr(m)) * m;
  return f0 + (Spectrum(1) - f0) * m5;
}

} // namespace candela
