#include "bsdf/layer_albedo.h"

#include "bsdf/albedo_coordinates.h"
#include "bsdf/facet_albedo.h"
#include "bsdf/fresnel.h"
#include "bsdf/visible_normals.h"

namespace candela {

namespace {

// Cosines by their roots, for most happens in grazing directions.
vec3 direction_of_root(float root, float azimuth = 0) {
  const float cosine = std::max(sqr(root), 1e-4f), sine = safe_sqrt(1 - sqr(cosine));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}
Microfacets facets_of(float coordinate) {
  const float alpha = alpha_at(coordinate);
  return {MicrofacetDistribution::ggx, alpha, alpha};
}

/// The mean of value(cosine) over visible normals, each weighted by the share of its light that leaves the
/// surface if nothing is absorbed.
template <class Value>
float mean_over_reflected(const Microfacets& facets, vec3 w, int count, Value value) {
  double sum = 0, weights = 0;
  for_visible_normals(facets, w, count, [&](vec3 h) {
    const float cosine = std::clamp(glm::dot(w, h), 0.0f, 1.0f);
    const vec3 wi = 2 * cosine * h - w;
    if (!(wi.z > 0)) return;
    const auto weight = static_cast<double>(facets.g2_reflection(w, wi));
    sum += weight * static_cast<double>(value(cosine));
    weights += weight;
  });
  return weights > 0 ? static_cast<float>(sum / weights) : 0;
}

/// The mean over what is reflected of a function of the cosine and of another coordinate in [0, 1], in
/// `others` points. By the root of the cosine and alpha; for other than round facets by the root of alpha_y /
/// alpha_x, alpha_x being the greater, and by the azimuth in quarter turns besides.
template <class Value>
GridTable<3> round_table(std::size_t others, Value value) {
  return {{48, 20, others}, [=](GridTable<3>::Point at) {
            return mean_over_reflected(facets_of(at[1]), direction_of_root(at[0]), 512,
                                       [&](float c) { return value(c, at[2]); });
          }};
}
template <class Value>
GridTable<5> anisotropic_table(std::size_t others, Value value) {
  return {{18, 8, 6, 7, others}, [=](GridTable<5>::Point at) {
            Microfacets facets = facets_of(at[1]);
            const float aspect = std::max(at[2], 0.1f);
            facets.alpha_x /= aspect;
            facets.alpha_y = std::max(facets.alpha_y * aspect, Microfacets::kMinAlpha);
            return mean_over_reflected(facets, direction_of_root(at[0], at[3] * 0.5f * kPi), 192,
                                       [&](float c) { return value(c, at[4]); });
          }};
}
float look_up(const GridTable<3>& table, const Microfacets& facets, vec3 w, float other) {
  return table({std::sqrt(std::abs(w.z)), alpha_coordinate(facets.alpha_x), other});
}
float look_up(const GridTable<5>& table, const Microfacets& facets, vec3 w, float other) {
  float x = std::abs(w.x), y = std::abs(w.y), aspect = std::sqrt(facets.alpha_y / facets.alpha_x);
  if (aspect > 1) std::swap(x, y), aspect = 1 / aspect;
  const float alpha = std::sqrt(facets.alpha_x * facets.alpha_y);
  return table(
      {std::sqrt(std::abs(w.z)), alpha_coordinate(alpha), aspect, std::atan2(y, x) * (2 * kInvPi), other});
}

float reflectance_at(float cosine, float coordinate) {
  return fresnel_dielectric(cosine, eta_at(coordinate));
}
/// What a piecewise linear function of the cosine's root has of its value at a node.
float node_share(float cosine, float coordinate) {
  constexpr float kSteps = ReflectedShares::kNodes - 1;
  return std::max(1 - std::abs(std::sqrt(cosine) - coordinate) * kSteps, 0.0f);
}

/// Of the error of tables.
float round_margin(vec3 w) { return 1.012f + 0.025f * sqr(sqr(sqr(1 - std::abs(w.z)))); }
float anisotropic_margin(vec3 w) { return 1.04f + 0.1f * sqr(sqr(1 - std::abs(w.z))); }

bool is_round(const Microfacets& facets) { return facets.alpha_x == facets.alpha_y; }

} // namespace

float lossless_share(const Microfacets& facets, vec3 w) {
  const bool anisotropic = !is_round(facets);
  const float margin = anisotropic ? 1.015f : 1.004f;
  return std::min(margin * FacetAlbedo::of(MicrofacetDistribution::ggx, anisotropic)(facets, w), 1.0f);
}

float layer_albedo(const Microfacets& facets, vec3 w, float eta) {
  if (eta == 1) return 0;
  float mean;
  if (is_round(facets)) {
    static const GridTable<3> table = round_table(24, reflectance_at);
    mean = round_margin(w) * look_up(table, facets, w, eta_coordinate(eta));
  } else {
    static const GridTable<5> table = anisotropic_table(12, reflectance_at);
    mean = anisotropic_margin(w) * look_up(table, facets, w, eta_coordinate(eta));
  }
  return lossless_share(facets, w) * std::min(mean, 1.0f);
}

float ReflectedShares::share(const Microfacets& facets, vec3 w, int node) {
  const float at = static_cast<float>(node) / (kNodes - 1);
  if (is_round(facets)) {
    static const GridTable<3> table = round_table(kNodes, node_share);
    return round_margin(w) * look_up(table, facets, w, at);
  }
  static const GridTable<5> table = anisotropic_table(kNodes, node_share);
  return anisotropic_margin(w) * look_up(table, facets, w, at);
}

float mean_fresnel(float eta) {
  static const GridTable<1> table({65}, [](GridTable<1>::Point at) {
    constexpr int kSteps = 2000;
    const float index = eta_at(at[0]);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float mu = (static_cast<float>(i) + 0.5f) / kSteps;
      sum += static_cast<double>(2 * mu * fresnel_dielectric(mu, index));
    }
    return static_cast<float>(sum / kSteps);
  });
  return table({eta_coordinate(eta)});
}

} // namespace candela
