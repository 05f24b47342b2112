#include "lights/atmosphere.h"

#include <vector>

namespace candela {

namespace {

/// Ozone's absorption cross-section at 233 K in the bands, m^2 (Serdyuchenko et al. 2014, means over 20 nm).
constexpr std::array<double, kSkyBands> kOzoneCrossSection = {
    1.095e-27, 4.142e-27, 1.214e-26, 2.993e-26, 6.338e-26, 1.191e-25, 1.871e-25, 2.923e-25,
    3.883e-25, 4.535e-25, 4.860e-25, 4.023e-25, 2.939e-25, 2.045e-25, 1.341e-25, 8.439e-26};

/// Optical thickness of the molecules above sea level (Bodhaine et al. 1999, "On Rayleigh Optical Depth
/// Calculations", eq. 30).
double molecule_thickness(double nanometres) {
  const double l = 1e-3 * nanometres, l2 = l * l;
  return 0.0021520 * (1.0455996 - 341.29061 / l2 - 0.90230850 * l2) /
         (1 + 0.0027059889 / l2 - 85.968563 * l2);
}

constexpr double kAngstromExponent = 1.3;        // of aerosol's extinction (Angstrom 1929)
constexpr double kMoleculesPerDobson = 2.687e20; // per m^2

/// exp(x) for x <= 0, relative error below 1e-6: the compiler makes vector code of it.
inline float exp_of_negative(float x) {
  const float y = std::max(x, -87.0f) * std::numbers::log2e_v<float>;
  const int whole = static_cast<int>(y - 0.5f);
  const float f = y - static_cast<float>(whole); // in [-1/2, 1/2]
  // The series of 2^f.
  const float power =
      1 + f * (0.69314718f +
               f * (0.24022651f +
                    f * (0.055504109f + f * (0.0096181291f + f * (0.0013333558f + f * 0.00015403530f)))));
  return power * std::bit_cast<float>((whole + 127) << 23);
}

constexpr int kColumnHeights = 64, kColumnAngles = 256;

} // namespace

const SkyBands& extraterrestrial_irradiance() {
  // ASTM G173-03 (Gueymard 2004), means over 20 nm.
  static const SkyBands bands = {1.4374f, 1.7096f, 1.7623f, 2.0276f, 1.9779f, 1.9375f, 1.8492f, 1.8723f,
                                 1.8423f, 1.8246f, 1.7674f, 1.6892f, 1.6257f, 1.5388f, 1.4927f, 1.4292f};
  return bands;
}

Atmosphere::Atmosphere(float turbidity, float ozone_dobson, float albedo) : ground_albedo(albedo) {
  const double haze = (std::max(static_cast<double>(turbidity), 1.0) - 1) * molecule_thickness(550);
  // The layer is a triangle: as much as half of its width at the peak.
  const double peak =
      std::max(static_cast<double>(ozone_dobson), 0.0) * kMoleculesPerDobson / kOzoneHalfWidth;
  for (int i = 0; i < kSkyBands; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double nm = sky_band_nanometres(i);
    // Over the height of the atmosphere that is modelled, not over an endless one.
    auto at_sea_level = [](double thickness, double height) {
      return static_cast<float>(thickness / (height * -std::expm1(-(kTop - kGround) / height)));
    };
    molecule_scattering[k] = at_sea_level(molecule_thickness(nm), kMoleculeHeight);
    aerosol_extinction[k] = at_sea_level(haze * std::pow(nm / 550, -kAngstromExponent), kAerosolHeight);
    aerosol_scattering[k] = kAerosolAlbedo * aerosol_extinction[k];
    ozone_absorption[k] = static_cast<float>(peak * kOzoneCrossSection[k]);
  }
  // Moments of the aerosol's phase function, by midpoints.
  std::array<double, 4> moments{};
  constexpr int kCosines = 4000;
  for (int i = 0; i < kCosines; ++i) {
    const double c = -1 + (2 * i + 1.0) / kCosines;
    const double mass =
        4 * std::numbers::pi / kCosines * static_cast<double>(aerosol_phase(static_cast<float>(c)));
    const std::array<double, 4> legendre = {1, c, 0.5 * (3 * c * c - 1), 0.5 * c * (5 * c * c - 3)};
    for (std::size_t l = 0; l < 4; ++l) moments[l] += mass * legendre[l];
  }
  forward = static_cast<float>(moments[3]); // the first that is left out
  for (std::size_t l = 0; l < 3; ++l)
    aerosol_moments[l] = static_cast<float>((moments[l] - moments[3]) / (1 - moments[3]));
  for (std::size_t k = 0; k < kSkyBands; ++k)
    aerosol_without_forward_[k] = aerosol_extinction[k] - forward * aerosol_scattering[k];
}

namespace {

std::vector<AirColumns> tabulate_columns() {
  constexpr double kGround = Atmosphere::kGround, kTop = Atmosphere::kTop;
  // By height, and by the length of the ray between its least and its most (Bruneton and Neyret 2008, section
  // 4): both are fine where columns change most.
  std::vector<AirColumns> columns(kColumnHeights * kColumnAngles);
  const double horizon = std::sqrt(kTop * kTop - kGround * kGround);
  for (int j = 0; j < kColumnHeights; ++j)
    for (int i = 0; i < kColumnAngles; ++i) {
      const double rho = horizon * j / (kColumnHeights - 1), r = std::sqrt(rho * rho + kGround * kGround);
      const double least = kTop - r, most = rho + horizon;
      const double length = least + (most - least) * i / (kColumnAngles - 1);
      const double mu =
          length > 0
              ? std::clamp((horizon * horizon - rho * rho - length * length) / (2 * r * length), -1.0, 1.0)
              : 1;
      AirColumns& sum = columns[static_cast<std::size_t>(j * kColumnAngles + i)];
      // Midpoints of steps that grow away from the point of the ray that is nearest to the ground.
      const double nearest = std::max(-r * mu, 0.0);
      auto add = [&](double from, double to) {
        constexpr int kSteps = 60;
        for (int s = 0; s < kSteps; ++s) {
          const double x = (s + 0.5) / kSteps, t = from + (to - from) * x * x,
                       dt = std::abs(to - from) * 2 * x / kSteps;
          const AirColumns d = Atmosphere::densities(std::sqrt(r * r + t * t + 2 * r * mu * t) - kGround);
          sum.molecules += dt * d.molecules, sum.aerosol += dt * d.aerosol, sum.ozone += dt * d.ozone;
        }
      };
      const double middle = std::min(nearest, length);
      if (middle > 0) add(middle, 0);
      add(middle, length);
    }
  return columns;
}

} // namespace

AirColumns Atmosphere::densities(double height) {
  const double h = std::max(height, 0.0);
  return {std::exp(-h / kMoleculeHeight), std::exp(-h / kAerosolHeight),
          std::max(1 - std::abs(h - kOzoneMiddle) / kOzoneHalfWidth, 0.0)};
}

float Atmosphere::molecule_phase(float cosine) { return 3 / (16 * kPi) * (1 + sqr(cosine)); }

float Atmosphere::aerosol_phase(float cosine) {
  constexpr float g = kAsymmetry;
  const float base = std::max(1 + g * g - 2 * g * cosine, 1e-6f);
  return 3 / (8 * kPi) * (1 - g * g) / (2 + g * g) * (1 + sqr(cosine)) / (base * std::sqrt(base));
}

AirColumns Atmosphere::columns_to_top(double r, double mu) {
  static const std::vector<AirColumns> columns = tabulate_columns();
  const double horizon = std::sqrt(kTop * kTop - kGround * kGround);
  const double rho = std::sqrt(std::max(r * r - kGround * kGround, 0.0));
  const double length =
      std::max(-r * mu + std::sqrt(std::max(r * r * (mu * mu - 1) + kTop * kTop, 0.0)), 0.0);
  const double least = kTop - r, most = rho + horizon;
  auto split = [](double x, int count, int& first) {
    const double at = std::clamp(x, 0.0, 1.0) * (count - 1);
    first = std::min(static_cast<int>(at), count - 2);
    return at - first;
  };
  int j = 0, i = 0;
  const double y = split(rho / horizon, kColumnHeights, j);
  const double x = split((length - least) / (most - least), kColumnAngles, i);
  const AirColumns* at = &columns[static_cast<std::size_t>(j * kColumnAngles + i)];
  auto mix = [&](double AirColumns::*m) {
    const double a = at[0].*m + x * (at[1].*m - at[0].*m);
    const double b = at[kColumnAngles].*m + x * (at[kColumnAngles + 1].*m - at[kColumnAngles].*m);
    return a + y * (b - a);
  };
  return {mix(&AirColumns::molecules), mix(&AirColumns::aerosol), mix(&AirColumns::ozone)};
}

void Atmosphere::transmittance(const AirColumns& columns, SkyBands& out) const {
  transmittance(columns, aerosol_extinction, out);
}

void Atmosphere::transmittance_with_forward(const AirColumns& columns, SkyBands& out) const {
  transmittance(columns, aerosol_without_forward_, out);
}

void Atmosphere::transmittance(const AirColumns& columns, const SkyBands& aerosol, SkyBands& out) const {
  const float m = static_cast<float>(columns.molecules), a = static_cast<float>(columns.aerosol),
              o = static_cast<float>(columns.ozone);
  for (std::size_t k = 0; k < kSkyBands; ++k)
    out[k] = exp_of_negative(-(molecule_scattering[k] * m + aerosol[k] * a + ozone_absorption[k] * o));
}

} // namespace candela
