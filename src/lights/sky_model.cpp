#include "lights/sky_model.h"

#include "core/basis.h"
#include "core/color_matching.h"
#include "lights/atmosphere_light.h"
#include "lights/sun_position.h"

namespace candela {

namespace {

/// What a band of 1 W/(m^2 nm) looks like: linear Rec. 709, in units of kDaylightEfficacy. The outer bands
/// stand for all that is beyond them.
const std::array<glm::dvec3, kSkyBands>& band_colors() {
  static const std::array<glm::dvec3, kSkyBands> colors = [] {
    std::array<glm::dvec3, kSkyBands> sums{};
    for (int nm = 360; nm <= 830; ++nm) {
      const int band = std::clamp((nm - 390) / 20, 0, kSkyBands - 1);
      sums[static_cast<std::size_t>(band)] += color_matching(nm + 0.5);
    }
    for (glm::dvec3& sum : sums) sum = rec709_from_xyz(sum) * (kLuminousEfficacy / kDaylightEfficacy);
    return sums;
  }();
  return colors;
}

/// Colours that no screen has lose what is negative.
Spectrum color_of(const SkyBands& relative, double factor) {
  const SkyBands& sun = extraterrestrial_irradiance();
  glm::dvec3 sum(0);
  for (std::size_t k = 0; k < kSkyBands; ++k)
    sum += static_cast<double>(relative[k] * sun[k]) * band_colors()[k];
  return vec3(glm::max(sum * factor, glm::dvec3(0)));
}

float in_range(float x, float least, float most) { return x > least ? std::min(x, most) : least; }

} // namespace

SunDisc::Sample SunDisc::sample(vec2 u) const {
  const vec3 local = sample_uniform_cone(u, one_minus_cos_max());
  const vec3 w = glm::normalize(Basis::from_normal(direction).to_world(local));
  // By the sample itself: the direction has fewer digits.
  const float share = std::min(
      (local.x * local.x + local.y * local.y) / (one_minus_cos_max() * (2 - one_minus_cos_max())), 1.0f);
  return {w, radiance_within(share), uniform_cone_pdf(one_minus_cos_max())};
}

Spectrum sky_irradiance(const Image& latlong) {
  glm::dvec3 sum(0);
  const double pi = std::numbers::pi;
  for (int y = 0; y < latlong.height / 2; ++y) {
    // The integral of cos sin over the row.
    const double upper = std::cos(pi * y / latlong.height), lower = std::cos(pi * (y + 1) / latlong.height);
    const double weight = 0.5 * (upper * upper - lower * lower) * 2 * pi / latlong.width;
    for (int x = 0; x < latlong.width; ++x) sum += weight * glm::dvec3(latlong.at(x, y));
  }
  return vec3(sum);
}

SkyModel make_sky(const SkyParameters& p, const Progress* progress) {
  const double half_turn = std::numbers::pi;
  const float quarter = 0.5f * kPi;
  const double elevation = static_cast<double>(in_range(p.sun_elevation, -quarter, quarter));
  const double azimuth = std::isfinite(p.sun_azimuth) ? static_cast<double>(p.sun_azimuth) : 0;
  const Atmosphere air(in_range(p.turbidity, 1, 20), in_range(p.ozone, 0, 1000),
                       in_range(p.ground_albedo, 0, 1));
  const double distance = static_cast<double>(in_range(p.sun_distance, 0.01f, 100));
  const double factor = 1 / (distance * distance);
  if (progress != nullptr) progress->check();
  const AtmosphereLight light(air, elevation);

  SkyModel model;
  SkyBands bands;
  light.direct(bands);
  model.sun.direction = sky_direction(elevation, azimuth);
  model.sun.irradiance = color_of(bands, factor);

  const int width = std::clamp(p.width, 4, 4096) / 4 * 4, height = width / 2;
  auto panorama = std::make_shared<Panorama>();
  panorama->name = "sky";
  Image& image = panorama->image;
  image = {width, height,
           std::vector<vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  // The sky is even about the plane of the sun: a row is computed by the angle from that, and then turned.
  std::vector<Spectrum> from_sun(static_cast<std::size_t>(width / 2) + 1);
  for (int y = 0; y < height / 2; ++y) {
    if (progress != nullptr) progress->check();
    const double row_elevation = half_turn * (0.5 - (y + 0.5) / height);
    for (std::size_t i = 0; i < from_sun.size(); ++i) {
      light.radiance(row_elevation, 2 * half_turn * static_cast<double>(i) / width, bands);
      from_sun[i] = color_of(bands, factor);
    }
    for (int x = 0; x < width; ++x) {
      // Columns go by azimuth from north to the east (lights/environment_map.h).
      const double turns = (x + 0.5) / width - azimuth / (2 * half_turn);
      const double at = std::abs(turns - std::round(turns)) * width;
      const std::size_t first = std::min(static_cast<std::size_t>(at), from_sun.size() - 2);
      image.at(x, y) =
          glm::mix(from_sun[first], from_sun[first + 1], static_cast<float>(at - static_cast<double>(first)));
    }
  }
  const Spectrum level = sky_irradiance(image) + model.sun.irradiance * std::max(model.sun.direction.y, 0.0f);
  const Spectrum ground = air.ground_albedo * kInvPi * level;
  std::fill(image.pixels.begin() + static_cast<std::ptrdiff_t>(width) * (height / 2), image.pixels.end(),
            ground);
  model.sky = std::move(panorama);
  return model;
}

} // namespace candela
