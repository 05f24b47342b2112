// The sky's radiance against random walks through the same air, and the air against published thicknesses.

#include "core/statistics.h"
#include "lights/atmosphere_light.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

using glm::dvec3;

constexpr double kDegree = std::numbers::pi / 180;

TEST(Atmosphere, HasPublishedOpticalThicknesses) {
  const Atmosphere air(2, 300, 0.2f);
  const AirColumns up = air.columns_to_top(Atmosphere::kGround, 1);
  // Bodhaine et al. 1999, table 3: 0.36022 at 400 nm, 0.14244 at 500 nm, 0.06779 at 600 nm, 0.03625 at 700
  // nm.
  for (auto [band, thickness] : {std::pair{0, 0.36022}, {5, 0.14244}, {10, 0.06779}, {15, 0.03625}})
    EXPECT_NEAR(up.molecules * static_cast<double>(air.molecule_scattering[static_cast<std::size_t>(band)]) /
                    thickness,
                1, 0.01)
        << band;
  // As thick as the molecules at 550 nm, by the meaning of a turbidity of 2.
  EXPECT_NEAR(up.aerosol * static_cast<double>(air.aerosol_extinction[8] + air.aerosol_extinction[7]) / 2,
              0.0967, 2e-3);
  // 300 Dobson units in the Chappuis band: about 0.039 at 600 nm.
  EXPECT_NEAR(up.ozone * static_cast<double>(air.ozone_absorption[10]), 0.0392, 5e-4);
  const Atmosphere clean(1, 0, 0);
  for (std::size_t k = 0; k < kSkyBands; ++k)
    EXPECT_EQ(clean.aerosol_extinction[k] + clean.ozone_absorption[k], 0);
}

TEST(Atmosphere, PhaseFunctionsAreDensities) {
  double molecules = 0, aerosol = 0, forward = 0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const float c = -1 + (2 * static_cast<float>(i) + 1) / n;
    molecules += 4 * std::numbers::pi / n * static_cast<double>(Atmosphere::molecule_phase(c));
    aerosol += 4 * std::numbers::pi / n * static_cast<double>(Atmosphere::aerosol_phase(c));
    forward += 4 * std::numbers::pi / n * static_cast<double>(c * Atmosphere::aerosol_phase(c));
  }
  EXPECT_NEAR(molecules, 1, 1e-4);
  EXPECT_NEAR(aerosol, 1, 1e-4);
  // Mean cosine of Cornette and Shanks 1992, eq. 10.
  const double g = static_cast<double>(Atmosphere::kAsymmetry);
  EXPECT_NEAR(forward, g * 3 * (4 + g * g) / (5 * (2 + g * g)), 1e-4);
}

/// Columns by brute force.
AirColumns summed_columns(double r, double mu) {
  const double length = -r * mu + std::sqrt(r * r * (mu * mu - 1) + Atmosphere::kTop * Atmosphere::kTop);
  AirColumns sum;
  const int n = 40000;
  for (int i = 0; i < n; ++i) {
    const double t = length * (i + 0.5) / n;
    const AirColumns d =
        Atmosphere::densities(std::sqrt(r * r + t * t + 2 * r * mu * t) - Atmosphere::kGround);
    sum.molecules += length / n * d.molecules, sum.aerosol += length / n * d.aerosol,
        sum.ozone += length / n * d.ozone;
  }
  return sum;
}

TEST(Atmosphere, TableOfColumnsHoldsTheirSums) {
  const Atmosphere air(3, 300, 0.2f);
  for (double height : {0.0, 300.0, 2000.0, 9000.0, 26e3, 50e3})
    for (double degrees : {90.0, 60.0, 20.0, 5.0, 1.0, 0.0, -0.5, -3.0}) {
      const double r = Atmosphere::kGround + height, mu = std::sin(degrees * kDegree);
      if (Atmosphere::meets_ground(r, mu)) continue;
      const AirColumns expected = summed_columns(r, mu), found = air.columns_to_top(r, mu);
      for (double AirColumns::*m : {&AirColumns::molecules, &AirColumns::aerosol, &AirColumns::ozone})
        EXPECT_NEAR(found.*m, expected.*m, 0.02 * expected.*m + 30) << height << ' ' << degrees;
    }
  // The air mass: Kasten and Young 1989 have 1.994 at 30 degrees, 10.31 at 5 and 26.3 at 1 (with refraction).
  const double zenith = air.columns_to_top(Atmosphere::kGround, 1).molecules;
  for (auto [degrees, mass, tolerance] : {std::tuple{30.0, 1.994, 0.01}, {5.0, 10.31, 0.3}, {1.0, 26.3, 1.5}})
    EXPECT_NEAR(air.columns_to_top(Atmosphere::kGround, std::sin(degrees * kDegree)).molecules / zenith, mass,
                tolerance);
}

TEST(AtmosphereLight, HarmonicsAreOrthonormal) {
  for (double sun_mu : {-0.3, 0.1, 0.95, 1.0}) {
    constexpr std::size_t n = AtmosphereLight::kMoments;
    std::array<std::array<double, n>, n> products{};
    constexpr int kSteps = 200;
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kSteps; ++i) {
        const double mu = -1 + (2 * j + 1.0) / kSteps, azimuth = 2 * std::numbers::pi * (i + 0.5) / kSteps;
        const double cosine =
            mu * sun_mu + std::sqrt((1 - mu * mu) * (1 - sun_mu * sun_mu)) * std::cos(azimuth);
        const auto y = AtmosphereLight::harmonics({Atmosphere::kGround, mu, sun_mu, cosine});
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t b = 0; b < n; ++b)
            products[a][b] += 4 * std::numbers::pi / (kSteps * kSteps) * static_cast<double>(y[a] * y[b]);
      }
    // A sun in the zenith lights all azimuths alike: those of x are 0 then.
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const bool of_x = a == 2 || a == 4 || a == 5, vanishes = sun_mu == 1 && of_x;
        EXPECT_NEAR(products[a][b], a == b && !vanishes ? 1 : 0, 2e-3) << a << ' ' << b << ' ' << sun_mu;
      }
  }
}

/// A random walk from the ground against the light, in one band. The distance to the next event is drawn by
/// delta tracking, what the sun sends there by a sum along its ray: nothing is shared but the air.
class Walk {
public:
  Walk(const Atmosphere& air, std::size_t band, dvec3 to_sun, std::mt19937_64& random)
      : air_(air), to_sun_(to_sun), random_(random),
        molecules_(static_cast<double>(air.molecule_scattering[band])),
        aerosol_(static_cast<double>(air.aerosol_extinction[band])),
        scattering_(static_cast<double>(air.aerosol_scattering[band])),
        ozone_(static_cast<double>(air.ozone_absorption[band])) {}

  struct Result {
    double once = 0, all = 0;
  };
  Result radiance(dvec3 w) {
    Result sum;
    dvec3 p(0, 0, Atmosphere::kGround + 1);
    double weight = 1;
    for (int order = 1; order < 100; ++order) {
      const double to_ground = distance(p, w, Atmosphere::kGround), to_top = distance(p, w, Atmosphere::kTop);
      const double end = to_ground > 0 ? to_ground : to_top;
      AirColumns d;
      double t = 0;
      bool scatters = false;
      while (true) {
        // The majorant of the part of the ray from here on: the least height of it.
        const double majorant = molecules_ + aerosol_ + ozone_;
        t -= std::log(1 - uniform_(random_)) / majorant;
        if (t >= end) break;
        d = Atmosphere::densities(glm::length(p + t * w) - Atmosphere::kGround);
        if (uniform_(random_) * majorant <
            molecules_ * d.molecules + aerosol_ * d.aerosol + ozone_ * d.ozone) {
          scatters = true;
          break;
        }
      }
      if (!scatters) {
        if (!(to_ground > 0)) return sum;
        p = glm::normalize(p + end * w) * (Atmosphere::kGround + 1);
        const dvec3 n = glm::normalize(p);
        weight *= static_cast<double>(air_.ground_albedo);
        sum.all += weight * std::max(glm::dot(n, to_sun_), 0.0) / std::numbers::pi * from_sun(p);
        w = glm::normalize(n + sphere());
        continue;
      }
      p += t * w;
      const double m = molecules_ * d.molecules, a = scattering_ * d.aerosol;
      weight *= (m + a) / (m + aerosol_ * d.aerosol + ozone_ * d.ozone);
      auto phase = [&](const dvec3& v) {
        const float c = static_cast<float>(glm::dot(v, w));
        return (m * static_cast<double>(Atmosphere::molecule_phase(c)) +
                a * static_cast<double>(Atmosphere::aerosol_phase(c))) /
               (m + a);
      };
      const double gain = weight * phase(to_sun_) * from_sun(p);
      sum.all += gain;
      if (order == 1) sum.once += gain;
      // The next direction: half by Henyey and Greenstein's density, half uniform.
      const double g = static_cast<double>(Atmosphere::kAsymmetry);
      dvec3 next = sphere();
      if (uniform_(random_) < 0.5) {
        const double s = (1 - g * g) / (1 - g + 2 * g * uniform_(random_)), c = (1 + g * g - s * s) / (2 * g);
        const dvec3 side = glm::normalize(next - glm::dot(next, w) * w);
        next = c * w + std::sqrt(std::max(1 - c * c, 0.0)) * side;
      }
      const double base = 1 + g * g - 2 * g * glm::dot(next, w);
      const double pdf = 0.25 / std::numbers::pi * (0.5 + 0.5 * (1 - g * g) / (base * std::sqrt(base)));
      weight *= phase(next) / pdf;
      w = next;
      if (weight < 0.2) {
        if (uniform_(random_) > weight) return sum;
        weight = 1;
      }
    }
    return sum;
  }

private:
  dvec3 sphere() {
    const double z = 1 - 2 * uniform_(random_), phi = 2 * std::numbers::pi * uniform_(random_),
                 r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  /// To a sphere about the earth's middle; not above 0: none.
  static double distance(const dvec3& p, const dvec3& w, double radius) {
    const double b = glm::dot(p, w), c = glm::dot(p, p) - radius * radius, q = b * b - c;
    if (q < 0) return -1;
    return c > 0 ? -b - std::sqrt(q) : -b + std::sqrt(q);
  }
  double from_sun(const dvec3& p) const {
    if (distance(p, to_sun_, Atmosphere::kGround) > 0) return 0;
    const double length = distance(p, to_sun_, Atmosphere::kTop);
    double sum = 0;
    const int n = 40;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;
      const AirColumns d =
          Atmosphere::densities(glm::length(p + length * x * x * to_sun_) - Atmosphere::kGround);
      sum += 2 * x / n * length * (molecules_ * d.molecules + aerosol_ * d.aerosol + ozone_ * d.ozone);
    }
    return std::exp(-sum);
  }

  const Atmosphere& air_;
  dvec3 to_sun_;
  std::mt19937_64& random_;
  std::uniform_real_distribution<double> uniform_;
  double molecules_, aerosol_, scattering_, ozone_;
};

TEST(AtmosphereLight, IsThatOfRandomWalksStatistical) {
  SCOPED_TRACE(test::seed_note());
  std::mt19937_64 random(test::fresh_seed());
  constexpr int kWalks = 6000;
  for (float turbidity : {1.0f, 2.0f, 5.0f})
    for (double sun : {88.0, 60.0, 5.0}) {
      const Atmosphere air(turbidity, 300, 0.3f);
      const AtmosphereLight light(air, sun * kDegree);
      const dvec3 to_sun(std::cos(sun * kDegree), 0, std::sin(sun * kDegree));
      // Not within some degrees of the sun: there most light comes by few walks, whose spread says little.
      for (auto [elevation, azimuth] : {std::pair{72.0, 0.0}, {30.0, 90.0}, {8.0, 180.0}}) {
        const double e = elevation * kDegree, a = azimuth * kDegree;
        SkyBands once, all;
        light.radiance_scattered_once(e, a, once);
        light.radiance(e, a, all);
        for (std::size_t band : {std::size_t{2}, std::size_t{11}}) {
          RunningStatistics walked_once, walked_all;
          Walk walk(air, band, to_sun, random);
          for (int i = 0; i < kWalks; ++i) {
            const auto found =
                walk.radiance({std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)});
            walked_once.add(found.once);
            walked_all.add(found.all);
          }
          const double o = static_cast<double>(once[band]), t = static_cast<double>(all[band]);
          EXPECT_NEAR(o, walked_once.mean(), 0.02 * o + 5.5 * std::sqrt(walked_once.variance_of_mean()))
              << turbidity << ' ' << sun << ' ' << elevation << ' ' << band;
          // In haze under a low sun most light was scattered many times, in peaks that moments do not hold.
          const double model = turbidity > 2 && sun < 10 ? 0.3 : 0.1;
          EXPECT_NEAR(t, walked_all.mean(), model * t + 5.5 * std::sqrt(walked_all.variance_of_mean()))
              << turbidity << ' ' << sun << ' ' << elevation << ' ' << band;
        }
      }
    }
}

} // namespace
} // namespace candela
