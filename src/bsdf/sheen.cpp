#include "bsdf/sheen.h"

namespace candela {

namespace {

constexpr std::size_t kSheenCosines = 160, kRoughnesses = 40;

/// Most happens at grazing angles, and at a low roughness.
float sheen_cosine_at(float coordinate) { return std::max(sqr(coordinate), 1e-4f); }
float roughness_at(float coordinate) {
  return SheenAlbedo::kMinRoughness + (1 - SheenAlbedo::kMinRoughness) * sqr(coordinate);
}
float roughness_coordinate(float roughness) {
  return safe_sqrt((roughness - SheenAlbedo::kMinRoughness) / (1 - SheenAlbedo::kMinRoughness));
}

/// The integral of the lobe and the cosine, over the root of the cosine and the azimuth (which is even).
float lobe_albedo(float cosine, float roughness) {
  constexpr int kAcross = 96, kAround = 64;
  const vec3 wo(safe_sqrt(1 - sqr(cosine)), 0, cosine);
  double sum = 0;
  for (int i = 0; i < kAcross; ++i) {
    const float root = (static_cast<float>(i) + 0.5f) / kAcross, mu = sqr(root);
    const float sine = safe_sqrt(1 - sqr(mu));
    for (int j = 0; j < kAround; ++j) {
      const float phi = (static_cast<float>(j) + 0.5f) * (kPi / kAround);
      const vec3 wi(sine * std::cos(phi), sine * std::sin(phi), mu);
      sum += static_cast<double>(sheen_lobe(wo, wi, roughness) * mu * 2 * root);
    }
  }
  return static_cast<float>(sum * 2 * static_cast<double>(kPi) / (kAcross * kAround));
}

} // namespace

SheenAlbedo::SheenAlbedo()
    : albedo_(
          {kSheenCosines, kRoughnesses},
          [](GridTable<2>::Point at) { return lobe_albedo(sheen_cosine_at(at[0]), roughness_at(at[1])); }),
      greatest_({kRoughnesses}, [this](GridTable<1>::Point at) {
        float greatest = 0;
        for (std::size_t i = 0; i < kSheenCosines; ++i)
          greatest = std::max(
              greatest, albedo_({static_cast<float>(i) / static_cast<float>(kSheenCosines - 1), at[0]}));
        return greatest;
      }) {}

const SheenAlbedo& SheenAlbedo::table() {
  static const SheenAlbedo table;
  return table;
}

float SheenAlbedo::operator()(float roughness, float cosine) const {
  return albedo_({std::sqrt(cosine), roughness_coordinate(roughness)});
}

float SheenAlbedo::scale(float roughness) const {
  return 1 / std::max(greatest_({roughness_coordinate(roughness)}), 1.0f);
}

} // namespace candela
