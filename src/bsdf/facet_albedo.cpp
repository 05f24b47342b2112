#include "bsdf/facet_albedo.h"

#include "bsdf/fresnel.h"
#include "bsdf/visible_normals.h"

namespace candela {

namespace {

/// Where albedo bends: cosines are told apart by their ratio to alpha.
float facet_cosine_coordinate(float cosine, float alpha) { return cosine * (1 + alpha) / (cosine + alpha); }
float facet_cosine_at(float coordinate, float alpha) { return coordinate * alpha / (1 + alpha - coordinate); }

vec3 direction_at(float cosine, float azimuth) {
  const float mu = std::clamp(cosine, 1e-4f, 1.0f), sine = safe_sqrt(1 - sqr(mu));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), mu};
}

/// The mean of value(h) over visible normals.
template <class Value>
float mean_over_visible_normals(const Microfacets& facets, vec3 w, int count, Value value) {
  double sum = 0;
  for_visible_normals(facets, w, count, [&](vec3 h) { sum += static_cast<double>(value(h)); });
  return static_cast<float>(sum / count);
}

float reflected_share(const Microfacets& facets, vec3 w, int count) {
  const float g1 = facets.g1(w);
  return mean_over_visible_normals(facets, w, count, [&](vec3 h) {
    const vec3 wi = 2 * glm::dot(w, h) * h - w;
    return wi.z > 0 ? facets.g2_reflection(w, wi) / g1 : 0;
  });
}

float scattered_share(const Microfacets& facets, vec3 w, float eta, int count) {
  const float g1 = facets.g1(w);
  return mean_over_visible_normals(facets, w, count, [&](vec3 h) {
    const float cosine = std::max(glm::dot(w, h), 0.0f), reflectance = fresnel_dielectric(cosine, eta);
    const vec3 mirrored = 2 * cosine * h - w;
    float sum = mirrored.z > 0 ? reflectance * facets.g2_reflection(w, mirrored) / g1 : 0;
    if (reflectance < 1) {
      const vec3 refracted = refract_about(w, h, eta);
      if (refracted.z < 0) sum += (1 - reflectance) * facets.g2_transmission(w, refracted) / g1;
    }
    return sum;
  });
}

/// Of the facets' slopes in the direction of an azimuth.
float alpha_along(const Microfacets& facets, float cosine, float sine) {
  return std::sqrt(sqr(facets.alpha_x * cosine) + sqr(facets.alpha_y * sine));
}

/// Amplitude of reflection at normal incidence, from eta = 1/3 to 3, wider about 1: there total reflection
/// begins at grazing angles, where little changes much.
float signed_eta_coordinate(float eta) {
  const float amplitude = (eta - 1) / (eta + 1);
  return 0.5f + std::copysign(std::sqrt(0.5f * std::abs(amplitude)), amplitude);
}
float signed_eta_at(float coordinate) {
  const float root = coordinate - 0.5f, amplitude = std::copysign(2 * sqr(root), root);
  return (1 + amplitude) / (1 - amplitude);
}

/// By cosine and root of alpha; for other than round facets alpha_x >= alpha_y, and the root of alpha_y /
/// alpha_x and the azimuth in quarter turns besides.
GridTable<4> facet_table(MicrofacetDistribution distribution, bool anisotropic) {
  if (!anisotropic)
    return {{40, 32, 2, 2}, [=](GridTable<4>::Point at) {
              const float alpha = std::max(sqr(at[1]), Microfacets::kMinAlpha);
              return reflected_share({distribution, alpha, alpha},
                                     direction_at(facet_cosine_at(at[0], alpha), 0), 512);
            }};
  // Visible normals of Beckmann's are slow.
  const int points = distribution == MicrofacetDistribution::ggx ? 256 : 64;
  return {{24, 16, 10, 12}, [=](GridTable<4>::Point at) {
            const float alpha = std::max(sqr(at[1]), Microfacets::kMinAlpha), aspect = std::max(at[2], 0.1f);
            const Microfacets facets{distribution, alpha / aspect, alpha * aspect};
            const float azimuth = at[3] * 0.5f * kPi;
            const float along = alpha_along(facets, std::cos(azimuth), std::sin(azimuth));
            return reflected_share(facets, direction_at(facet_cosine_at(at[0], along), azimuth), points);
          }};
}

} // namespace

FacetAlbedo::FacetAlbedo(MicrofacetDistribution distribution, bool anisotropic)
    : table_(facet_table(distribution, anisotropic)), anisotropic_(anisotropic) {}

const FacetAlbedo& FacetAlbedo::of(MicrofacetDistribution distribution, bool anisotropic) {
  if (distribution == MicrofacetDistribution::ggx) {
    if (!anisotropic) {
      static const FacetAlbedo round(distribution, false);
      return round;
    }
    static const FacetAlbedo table(distribution, true);
    return table;
  }
  if (!anisotropic) {
    static const FacetAlbedo round(distribution, false);
    return round;
  }
  static const FacetAlbedo table(distribution, true);
  return table;
}

float FacetAlbedo::operator()(const Microfacets& facets, vec3 w) const {
  const float alpha = std::sqrt(facets.alpha_x * facets.alpha_y), r = std::sqrt(alpha),
              cosine = std::abs(w.z);
  if (!anisotropic_) return table_({facet_cosine_coordinate(cosine, alpha), r, 0, 0});
  float x = std::abs(w.x), y = std::abs(w.y), aspect = std::sqrt(facets.alpha_y / facets.alpha_x);
  const float sine = std::sqrt(sqr(x) + sqr(y));
  const float along = sine > 0 ? alpha_along(facets, x / sine, y / sine) : facets.alpha_x;
  if (aspect > 1) std::swap(x, y), aspect = 1 / aspect;
  return table_({facet_cosine_coordinate(cosine, along), r, aspect, std::atan2(y, x) * (2 * kInvPi)});
}

InterfaceAlbedo::InterfaceAlbedo(MicrofacetDistribution distribution)
    : table_({32, 20, 31}, [=](GridTable<3>::Point at) {
        const float alpha = std::max(sqr(at[1]), Microfacets::kMinAlpha);
        return scattered_share({distribution, alpha, alpha}, direction_at(facet_cosine_at(at[0], alpha), 0),
                               signed_eta_at(at[2]), 384);
      }) {}

const InterfaceAlbedo& InterfaceAlbedo::of(MicrofacetDistribution distribution) {
  if (distribution == MicrofacetDistribution::ggx) {
    static const InterfaceAlbedo ggx(distribution);
    return ggx;
  }
  static const InterfaceAlbedo beckmann(distribution);
  return beckmann;
}

float InterfaceAlbedo::operator()(const Microfacets& facets, vec3 w, float eta) const {
  const float alpha = std::sqrt(facets.alpha_x * facets.alpha_y);
  return table_(
      {facet_cosine_coordinate(std::abs(w.z), alpha), std::sqrt(alpha), signed_eta_coordinate(eta)});
}

} // namespace candela
