#include "bsdf/coat_albedo.h"

#include "bsdf/albedo_coordinates.h"
#include "bsdf/fresnel.h"
#include "bsdf/visible_normals.h"

namespace candela {

namespace {

constexpr std::size_t kCosines = 56, kAlphas = 28, kEtas = 24;

/// Where the reflectance bends: masking does below cosines of about alpha, the Fresnel equations' everywhere
/// and most at grazing angles.
float coat_cosine_coordinate(float cosine, float alpha) {
  return cosine * (0.3f * (1 + alpha) / (cosine + alpha) + 0.7f * 1.5f / (cosine + 0.5f));
}
float coat_cosine_at(float coordinate, float alpha) {
  float low = 0, high = 1;
  for (int i = 0; i < 30; ++i) {
    const float middle = 0.5f * (low + high);
    (coat_cosine_coordinate(middle, alpha) < coordinate ? low : high) = middle;
  }
  return high;
}

float grid_point(std::size_t i, std::size_t count) {
  return static_cast<float>(i) / static_cast<float>(count - 1);
}
std::size_t grid_index(float point, std::size_t count) {
  return static_cast<std::size_t>(std::lround(point * static_cast<float>(count - 1)));
}

/// For each eta.
std::array<float, kEtas> reflected_shares(const Microfacets& facets, float cosine) {
  const int count = facets.distribution == MicrofacetDistribution::ggx ? 4096 : 2048;
  const float mu = std::clamp(cosine, 1e-4f, 1.0f);
  const vec3 w(safe_sqrt(1 - sqr(mu)), 0, mu);
  std::array<double, kEtas> sum{};
  for_visible_normals(facets, w, count, [&](vec3 h) {
    const float cos_h = std::clamp(glm::dot(w, h), 0.0f, 1.0f);
    const vec3 wi = 2 * cos_h * h - w;
    if (!(wi.z > 0)) return;
    const float seen = facets.g2_reflection(w, wi) / facets.g1(w);
    for (std::size_t k = 0; k < kEtas; ++k)
      sum[k] += static_cast<double>(seen * fresnel_dielectric(cos_h, eta_at(grid_point(k, kEtas))));
  });
  std::array<float, kEtas> shares;
  for (std::size_t k = 0; k < kEtas; ++k) shares[k] = static_cast<float>(sum[k] / count);
  return shares;
}

/// By cosine, root of alpha, and eta. The facets' normals are sampled once for all etas.
GridTable<3> reflectance_table(MicrofacetDistribution distribution) {
  std::vector<std::array<float, kEtas>> shares(kCosines * kAlphas);
  const GridTable<2> each({kCosines, kAlphas}, [&](GridTable<2>::Point at) {
    const float alpha = alpha_at(at[1]);
    shares[grid_index(at[0], kCosines) + kCosines * grid_index(at[1], kAlphas)] =
        reflected_shares({distribution, alpha, alpha}, coat_cosine_at(at[0], alpha));
    return 0.0f;
  });
  return {{kCosines, kAlphas, kEtas}, [&](GridTable<3>::Point at) {
            return shares[grid_index(at[0], kCosines) + kCosines * grid_index(at[1], kAlphas)]
                         [grid_index(at[2], kEtas)];
          }};
}

} // namespace

float diffuse_fresnel_reflectance(float eta) {
  const double n = static_cast<double>(eta), n2 = n * n, n4 = n2 * n2;
  // The terms cancel each other where nothing is reflected.
  if (n - 1 < 1e-5) return 0;
  const double p = n2 + 1, m = n2 - 1;
  return static_cast<float>(0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                            n2 * m * m / (p * p * p) * std::log((n - 1) / (n + 1)) -
                            2 * n2 * n * (n2 + 2 * n - 1) / (p * (n4 - 1)) +
                            8 * n4 * (n4 + 1) / (p * (n4 - 1) * (n4 - 1)) * std::log(n));
}

CoatAlbedo::CoatAlbedo(MicrofacetDistribution distribution)
    : table_(reflectance_table(distribution)),
      // Of what the table says, so that a coat and what is below it add up.
      mean_({kAlphas, kEtas}, [this](GridTable<2>::Point at) {
        double sum = 0;
        const int count = 1000;
        for (int i = 0; i < count; ++i) {
          const float cosine = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
          sum += static_cast<double>(2 * cosine * (*this)(alpha_at(at[0]), cosine, eta_at(at[1])));
        }
        return static_cast<float>(sum / count);
      }) {}

const CoatAlbedo& CoatAlbedo::of(MicrofacetDistribution distribution) {
  if (distribution == MicrofacetDistribution::ggx) {
    static const CoatAlbedo ggx(distribution);
    return ggx;
  }
  static const CoatAlbedo beckmann(distribution);
  return beckmann;
}

float CoatAlbedo::operator()(float alpha, float cosine, float eta) const {
  return table_({coat_cosine_coordinate(cosine, alpha), alpha_coordinate(alpha), eta_coordinate(eta)});
}

float CoatAlbedo::mean(float alpha, float eta) const {
  return mean_({alpha_coordinate(alpha), eta_coordinate(eta)});
}

} // namespace candela
