#pragma once

#include "bsdf/f82_tint.h"
#include "bsdf/fuzz.h"
#include "bsdf/layer_albedo.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/thin_film.h"

namespace candela {

/// The values of an OpenPBR surface that reach its closure, by the specification's names.
struct OpenPbrValues {
  Spectrum base_color{0.8f}; ///< weighted
  float base_diffuse_roughness = 0;
  float base_metalness = 0;
  float specular_weight = 1;
  Spectrum specular_color{1};
  float specular_roughness = 0.3f, specular_roughness_anisotropy = 0;
  float specular_ior = 1.5f; ///< in [1, 3]
  float transmission_weight = 0;
  Spectrum transmission_color{1};
  float coat_weight = 0;
  Spectrum coat_color{1};
  float coat_roughness = 0, coat_roughness_anisotropy = 0;
  float coat_ior = 1.6f; ///< in [1, 3]
  float coat_darkening = 1;
  float fuzz_weight = 0;
  Spectrum fuzz_color{1};
  float fuzz_roughness = 0.5f;
  float thin_film_weight = 0, thin_film_thickness = 0.5f, thin_film_ior = 1.4f; ///< thickness in micrometres
};

namespace open_pbr {

inline float lerp(float a, float b, float t) { return a + t * (b - a); }
inline Spectrum lerp(Spectrum a, Spectrum b, float t) { return a + t * (b - a); }

/// "Microfacet model", eq. openpbr-anisotropy-formula; alpha_t^2 + alpha_b^2 stays 2 roughness^4.
inline Microfacets facets(float roughness, float anisotropy) {
  const float across = std::max(1 - anisotropy, 0.01f), // FacetAlbedo knows none narrower
      along = sqr(roughness) * std::sqrt(2 / (1 + sqr(across)));
  return {MicrofacetDistribution::ggx, std::max(along, Microfacets::kMinAlpha),
          std::max(across * along, Microfacets::kMinAlpha)};
}

/// Of the base below a rough coat ("Roughening").
inline float base_roughness(const OpenPbrValues& v) {
  const float base4 = sqr(sqr(v.specular_roughness)), coat4 = sqr(sqr(v.coat_roughness));
  return lerp(v.specular_roughness, std::sqrt(std::sqrt(std::min(base4 + 2 * coat4, 1.0f))), v.coat_weight);
}

/// Index of the base over that of what is on it. Where the coat is the denser, their ratio is taken the other
/// way round, so that nothing is totally reflected that came in through the coat.
inline float unweighted_eta(const OpenPbrValues& v) {
  const float under_coat = v.specular_ior / v.coat_ior;
  return lerp(v.specular_ior, std::max(under_coat, 1 / under_coat), v.coat_weight);
}
/// With the reflectance at normal incidence times specular_weight (eq. modulated_ior); at most 3.
inline float eta(const OpenPbrValues& v) {
  const float plain = unweighted_eta(v);
  const float amplitude = std::min(std::sqrt(v.specular_weight) * (plain - 1) / (plain + 1), 0.5f);
  return (1 + amplitude) / (1 - amplitude);
}

/// Of metal's reflectance.
inline float metal_weight(const OpenPbrValues& v) { return std::min(v.specular_weight, 1.0f); }

/// What the base keeps of its light below a coat that mirrors some back to it ("Darkening").
inline Spectrum darkening(const OpenPbrValues& v, float cosine) {
  if (!(v.coat_weight * v.coat_darkening > 0)) return Spectrum(1);
  const float once = sqr((eta(v) - 1) / (eta(v) + 1));
  const float base = lerp(lerp(1, v.specular_roughness, once), v.specular_roughness, v.base_metalness);
  const float smooth = fresnel_dielectric(cosine, v.coat_ior);
  const float rough = 1 - (1 - mean_fresnel(v.coat_ior)) / sqr(v.coat_ior);
  const float returned = lerp(smooth, rough, base);
  const Spectrum albedo = v.base_color * lerp(1, metal_weight(v), v.base_metalness);
  const Spectrum left = Spectrum(1 - returned) / glm::max(Spectrum(1) - albedo * returned, Spectrum(1e-6f));
  return lerp(Spectrum(1), left, v.coat_weight * v.coat_darkening);
}

/// Transmittance of the coat along a direction outside at that cosine ("View-dependent absorption").
inline Spectrum coat_transmittance(const OpenPbrValues& v, float cosine) {
  if (v.coat_color == Spectrum(1)) return Spectrum(1);
  const float inside = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(v.coat_ior));
  return glm::pow(v.coat_color, Spectrum(0.5f / std::max(inside, 1e-3f)));
}

/// Below a coat that is denser than the film their ratio is taken the other way round, as the base's is, at
/// the same optical path: else the film would mirror all light in grazing directions.
inline ThinFilm film_of(const OpenPbrValues& v) {
  const float outside = lerp(1, v.coat_ior, v.coat_weight);
  const float ior = std::max(v.thin_film_ior, sqr(outside) / v.thin_film_ior);
  return {ior, 1000 * v.thin_film_thickness * v.thin_film_ior / ior, outside};
}

/// The reflectances of the base's facets.
class BaseFresnel {
public:
  explicit BaseFresnel(const OpenPbrValues& v)
      : v_(v), eta_(eta(v)), metal_{v.base_color, v.specular_color}, film_(film_of(v)) {}

  float eta_of_base() const { return eta_; }
  bool has_film() const { return v_.thin_film_weight > 0; }

  Spectrum dielectric(float cosine) const {
    const Spectrum plain(fresnel_dielectric(cosine, eta_));
    return has_film() ? lerp(plain, film(cosine, eta_), v_.thin_film_weight) : plain;
  }
  /// Where the film is.
  Spectrum film(float cosine, float eta) const { return film_.over_dielectric(cosine, eta * film_.outside); }
  Spectrum metal(float cosine) const {
    const Spectrum plain = metal_(cosine);
    const Spectrum seen =
        has_film() ? lerp(plain, film_.over_mirror(cosine, metal_), v_.thin_film_weight) : plain;
    return metal_weight(v_) * seen;
  }

private:
  const OpenPbrValues& v_;
  float eta_;
  F82Tint metal_;
  ThinFilm film_;
};

} // namespace open_pbr

} // namespace candela
