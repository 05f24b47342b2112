#include "lights/atmosphere_light.h"

namespace candela {

namespace {

constexpr double kSunRadius = 0.265 * std::numbers::pi / 180;

/// Of the angle to the vertical of rays that graze the ground.
double horizon_cosine(double r) {
  const double ratio = std::min(Atmosphere::kGround / r, 1.0);
  return -std::sqrt(1 - ratio * ratio);
}

/// To the ground or the top, whichever is nearer.
double length_of_ray(double r, double mu) {
  const double b = r * mu;
  auto root = [&](double radius) { return std::sqrt(std::max(b * b - r * r + radius * radius, 0.0)); };
  if (Atmosphere::meets_ground(r, mu)) return std::max(-b - root(Atmosphere::kGround), 0.0);
  return std::max(-b + root(Atmosphere::kTop), 0.0);
}

} // namespace

AtmosphereLight::AtmosphereLight(const Atmosphere& air, double sun_elevation)
    : air_(air), sun_elevation_(sun_elevation),
      angles_(sun_elevation > 20 * std::numbers::pi / 180 ? 5 : 12) {
  // Rays from sea level leave the atmosphere at most eight degrees around the earth.
  const double zenith = 0.5 * std::numbers::pi - sun_elevation, reach = 8.0 * std::numbers::pi / 180;
  first_angle_ = std::max(zenith - reach, 0.0);
  angle_step_ = (std::min(zenith + reach, std::numbers::pi) - first_angle_) / (angles_ - 1);
  moments_.resize(static_cast<std::size_t>(kHeights * angles_));
  iterate();
}

AtmosphereLight::Place AtmosphereLight::along(const Place& from, double distance) {
  const double r = std::sqrt(from.r * from.r + distance * distance + 2 * from.r * from.mu * distance);
  return {r, std::clamp((from.r * from.mu + distance) / r, -1.0, 1.0),
          std::clamp((from.r * from.sun_mu + distance * from.sun_cosine) / r, -1.0, 1.0), from.sun_cosine};
}

/// Of the ray's direction, where z is the vertical and the sun is in the half plane of x.
std::array<float, AtmosphereLight::kMoments> AtmosphereLight::harmonics(const Place& at) {
  const double sine = std::sqrt(std::max(1 - at.mu * at.mu, 0.0));
  const double sun_sine = std::sqrt(std::max(1 - at.sun_mu * at.sun_mu, 0.0));
  double x = 0, y2 = 0; // under a sun in the zenith no azimuth is any other
  if (sun_sine > 1e-7) {
    x = std::clamp((at.sun_cosine - at.mu * at.sun_mu) / sun_sine, -sine, sine);
    y2 = sine * sine - x * x;
  }
  const double z = at.mu;
  return {0.28209479f,
          static_cast<float>(0.48860251 * z),
          static_cast<float>(0.48860251 * x),
          static_cast<float>(0.31539157 * (3 * z * z - 1)),
          static_cast<float>(1.09254843 * x * z),
          static_cast<float>(0.54627422 * (x * x - y2))};
}

/// The share of the sun's disc above the horizon, about.
double AtmosphereLight::sun_visibility(const Place& at) const {
  const double ratio = std::min(Atmosphere::kGround / at.r, 1.0);
  const double x = (at.sun_mu - horizon_cosine(at.r)) / (ratio * std::sin(kSunRadius)); // -1: set, 1: risen
  if (x <= -1) return 0;
  if (x >= 1) return 1;
  return (std::acos(-x) + x * std::sqrt(1 - x * x)) / std::numbers::pi;
}

void AtmosphereLight::gather(const Place& from, int steps, bool first_scattering, SkyBands& out,
                             AirColumns& columns) const {
  SkyBands sum{};
  AirColumns c;
  const double length = length_of_ray(from.r, from.mu);
  constexpr std::array<std::size_t, kMoments> kDegree = {0, 1, 1, 2, 2, 2};
  for (int s = 0; s < steps; ++s) {
    // Steps grow with the square of their number, as the air is densest where rays begin.
    const double x = (s + 0.5) / steps, dt = length * 2 * x / steps;
    const Place at = along(from, length * x * x);
    const AirColumns d = Atmosphere::densities(at.r - Atmosphere::kGround);
    c.molecules += 0.5 * dt * d.molecules, c.aerosol += 0.5 * dt * d.aerosol, c.ozone += 0.5 * dt * d.ozone;
    SkyBands through;
    air_.transmittance_with_forward(c, through);
    Moments light;
    moments_at(at, light);
    const double visible = first_scattering ? sun_visibility(at) : 0;
    if (visible > 0) {
      // A disc that is half set is seen along its upper half.
      SkyBands sun;
      air_.transmittance_with_forward(air_.columns_to_top(at.r, std::max(at.sun_mu, horizon_cosine(at.r))),
                                      sun);
      const auto towards_sun = harmonics({at.r, at.sun_mu, at.sun_mu, 1});
      for (std::size_t m = 0; m < kMoments; ++m)
        for (std::size_t k = 0; k < kSkyBands; ++k)
          light[m][k] += towards_sun[m] * static_cast<float>(visible) * sun[k];
    }
    const auto basis = harmonics(at);
    const float molecules = static_cast<float>(d.molecules * dt);
    const float aerosol = static_cast<float>(d.aerosol * dt) * (1 - air_.forward);
    for (std::size_t m = 0; m < kMoments; ++m) {
      const float by_molecules = molecules * Atmosphere::kMoleculeMoments[kDegree[m]] * basis[m];
      const float by_aerosol = aerosol * air_.aerosol_moments[kDegree[m]] * basis[m];
      for (std::size_t k = 0; k < kSkyBands; ++k)
        sum[k] += (by_molecules * air_.molecule_scattering[k] + by_aerosol * air_.aerosol_scattering[k]) *
                  light[m][k] * through[k];
    }
    c.molecules += 0.5 * dt * d.molecules, c.aerosol += 0.5 * dt * d.aerosol, c.ozone += 0.5 * dt * d.ozone;
  }
  out = sum;
  columns = c;
}

/// Of the diffuse ground under the sun and the sky. Irradiance by the moments: Ramamoorthi and Hanrahan 2001,
/// "An Efficient Representation for Irradiance Environment Maps", eq. 8.
void AtmosphereLight::ground_radiance(const Place& at, SkyBands& out) const {
  Moments sky;
  moments_at({Atmosphere::kGround, 1, at.sun_mu, at.sun_mu}, sky);
  SkyBands sun{};
  if (at.sun_mu > 0)
    air_.transmittance_with_forward(air_.columns_to_top(Atmosphere::kGround, at.sun_mu), sun);
  constexpr float a0 = 0.28209479f * kPi, a1 = 0.48860251f * 2 * kPi / 3, a2 = 0.31539157f * 2 * kPi / 4;
  for (std::size_t k = 0; k < kSkyBands; ++k)
    out[k] = air_.ground_albedo * kInvPi *
             std::max(a0 * sky[0][k] + a1 * sky[1][k] + a2 * sky[3][k] +
                          std::max(static_cast<float>(at.sun_mu), 0.0f) * sun[k],
                      0.0f);
}

/// Heights are close together at the ground.
AtmosphereLight::Place AtmosphereLight::node(int height, int angle) const {
  const double share = static_cast<double>(height) / (kHeights - 1);
  const double r = Atmosphere::kGround + share * share * (Atmosphere::kTop - Atmosphere::kGround);
  return {r, 1, std::cos(first_angle_ + angle * angle_step_), 0};
}

void AtmosphereLight::moments_at(const Place& at, Moments& out) const {
  const double share = std::sqrt(
      std::clamp((at.r - Atmosphere::kGround) / (Atmosphere::kTop - Atmosphere::kGround), 0.0, 1.0));
  const double y = share * (kHeights - 1),
               x = std::clamp((std::acos(at.sun_mu) - first_angle_) / angle_step_, 0.0, angles_ - 1.0);
  const int j = std::min(static_cast<int>(y), kHeights - 2), i = std::min(static_cast<int>(x), angles_ - 2);
  const float fy = static_cast<float>(y - j), fx = static_cast<float>(x - i);
  const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
  const Moments* row = &moments_[static_cast<std::size_t>(j * angles_ + i)];
  const Moments *a = row, *b = row + 1, *c = row + angles_, *d = row + angles_ + 1;
  for (std::size_t m = 0; m < kMoments; ++m)
    for (std::size_t k = 0; k < kSkyBands; ++k)
      out[m][k] = w00 * (*a)[m][k] + w10 * (*b)[m][k] + w01 * (*c)[m][k] + w11 * (*d)[m][k];
}

/// Each turn adds an order of scattering. The orders soon form a geometric series, whose rest is added.
void AtmosphereLight::iterate() {
  constexpr int kCosines = 12, kAzimuths = 5, kSteps = 16, kMostOrders = 12;
  std::vector<Moments> next(moments_.size()), last_change(moments_.size());
  for (int order = 1; order <= kMostOrders; ++order) {
    double change = 0, whole = 0;
    for (int j = 0; j < kHeights; ++j)
      for (int i = 0; i < angles_; ++i) {
        const Place place = node(j, i);
        const std::size_t index = static_cast<std::size_t>(j * angles_ + i);
        const double sun_sine = std::sqrt(std::max(1 - place.sun_mu * place.sun_mu, 0.0));
        Moments sum{};
        for (int c = 0; c < kCosines; ++c)
          for (int a = 0; a < kAzimuths; ++a) {
            const double mu = -1 + (2 * c + 1.0) / kCosines,
                         azimuth = std::numbers::pi * (a + 0.5) / kAzimuths;
            const Place ray{place.r, mu, place.sun_mu,
                            mu * place.sun_mu + std::sqrt(1 - mu * mu) * sun_sine * std::cos(azimuth)};
            SkyBands light;
            AirColumns columns;
            gather(ray, kSteps, true, light, columns);
            if (Atmosphere::meets_ground(ray.r, mu) || (j == 0 && mu < 0)) {
              SkyBands ground, through;
              ground_radiance(along(ray, length_of_ray(ray.r, mu)), ground);
              air_.transmittance_with_forward(columns, through);
              for (std::size_t k = 0; k < kSkyBands; ++k) light[k] += ground[k] * through[k];
            }
            const auto basis = harmonics(ray);
            for (std::size_t m = 0; m < kMoments; ++m)
              for (std::size_t k = 0; k < kSkyBands; ++k)
                sum[m][k] += 4 * kPi / (kCosines * kAzimuths) * basis[m] * light[k];
          }
        next[index] = sum;
        for (std::size_t k = 0; k < kSkyBands; ++k) {
          change += std::abs(static_cast<double>(sum[0][k] - moments_[index][0][k]));
          whole += static_cast<double>(sum[0][k]);
        }
      }
    const bool ends = !(change > 0.02 * whole) || order == kMostOrders;
    for (std::size_t n = 0; n < next.size(); ++n) {
      Moments now = next[n];
      for (std::size_t k = 0; k < kSkyBands; ++k) {
        const float step = next[n][0][k] - moments_[n][0][k], before = last_change[n][0][k];
        const float ratio = ends && before > 0 ? std::clamp(step / before, 0.0f, 0.9f) : 0;
        for (std::size_t m = 0; m < kMoments; ++m) {
          last_change[n][m][k] = next[n][m][k] - moments_[n][m][k];
          now[m][k] += ratio / (1 - ratio) * last_change[n][m][k];
        }
      }
      moments_[n] = now;
    }
    if (ends) return;
  }
}

void AtmosphereLight::radiance_scattered_once(double elevation, double azimuth_from_sun,
                                              SkyBands& out) const {
  once(elevation, azimuth_from_sun, false, out);
}

void AtmosphereLight::radiance(double elevation, double azimuth_from_sun, SkyBands& out) const {
  constexpr int kSteps = 40;
  SkyBands again;
  AirColumns columns;
  gather(from_ground(elevation, azimuth_from_sun), kSteps, false, again, columns);
  once(elevation, azimuth_from_sun, true, out);
  // Moments may undershoot where there is next to no light.
  for (std::size_t k = 0; k < kSkyBands; ++k) out[k] = std::max(out[k] + again[k], 0.0f);
}

/// With the whole phase functions; with the transmittance that knows of the forward peak, or the true one.
void AtmosphereLight::once(double elevation, double azimuth_from_sun, bool with_forward,
                           SkyBands& out) const {
  constexpr int kSteps = 64;
  const Place from = from_ground(elevation, azimuth_from_sun);
  const double length = length_of_ray(from.r, from.mu);
  const float by_molecules = Atmosphere::molecule_phase(static_cast<float>(from.sun_cosine));
  const float by_aerosol = Atmosphere::aerosol_phase(static_cast<float>(from.sun_cosine));
  AirColumns before;
  out = {};
  for (int s = 0; s < kSteps; ++s) {
    const double x = (s + 0.5) / kSteps, dt = length * 2 * x / kSteps;
    const Place at = along(from, length * x * x);
    const AirColumns d = Atmosphere::densities(at.r - Atmosphere::kGround);
    const double visible = sun_visibility(at);
    if (visible > 0) {
      const AirColumns sun = air_.columns_to_top(at.r, std::max(at.sun_mu, horizon_cosine(at.r)));
      const AirColumns both{before.molecules + 0.5 * dt * d.molecules + sun.molecules,
                            before.aerosol + 0.5 * dt * d.aerosol + sun.aerosol,
                            before.ozone + 0.5 * dt * d.ozone + sun.ozone};
      SkyBands through;
      if (with_forward)
        air_.transmittance_with_forward(both, through);
      else
        air_.transmittance(both, through);
      const float molecules = static_cast<float>(d.molecules * dt * visible) * by_molecules;
      const float aerosol = static_cast<float>(d.aerosol * dt * visible) * by_aerosol;
      for (std::size_t k = 0; k < kSkyBands; ++k)
        out[k] +=
            (molecules * air_.molecule_scattering[k] + aerosol * air_.aerosol_scattering[k]) * through[k];
    }
    before.molecules += dt * d.molecules, before.aerosol += dt * d.aerosol, before.ozone += dt * d.ozone;
  }
}

AtmosphereLight::Place AtmosphereLight::from_ground(double elevation, double azimuth_from_sun) const {
  const double mu = std::sin(std::max(elevation, 0.0)), sun_mu = std::sin(sun_elevation_);
  const double cosine =
      mu * sun_mu + std::sqrt(1 - mu * mu) * std::cos(sun_elevation_) * std::cos(azimuth_from_sun);
  return {Atmosphere::kGround, mu, sun_mu, std::clamp(cosine, -1.0, 1.0)};
}

void AtmosphereLight::direct(SkyBands& out) const {
  const double mu = std::sin(sun_elevation_);
  const double visible = sun_visibility({Atmosphere::kGround, 1, mu, mu});
  air_.transmittance(air_.columns_to_top(Atmosphere::kGround, std::max(mu, 0.0)), out);
  for (float& value : out) value *= static_cast<float>(visible);
}

} // namespace candela
