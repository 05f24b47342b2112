#include "media/grid_medium.h"

#include "core/blackbody.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Luminance of a black body, up to a factor.
double glow_luminance(double kelvin) {
  double sum = 0;
  for (double nm = 360; nm <= 830; nm += 5) sum += planck_radiance(nm, kelvin) * color_matching(nm).y;
  return sum;
}

/// Trilinear in an array of a value for each cell.
template <class T>
T value_in_grid(const VolumeGrid& grid, const std::vector<T>& values, vec3 cell) {
  const vec3 last(grid.cells - 1), p = glm::clamp(cell, vec3(0), last);
  const glm::ivec3 low = glm::min(glm::ivec3(p), glm::max(grid.cells - 2, glm::ivec3(0)));
  const glm::ivec3 high = glm::min(low + 1, grid.cells - 1);
  const vec3 f = p - vec3(low);
  auto at = [&](int x, int y, int z) {
    return values[(static_cast<std::size_t>(z) * static_cast<std::size_t>(grid.cells.y) +
                   static_cast<std::size_t>(y)) *
                      static_cast<std::size_t>(grid.cells.x) +
                  static_cast<std::size_t>(x)];
  };
  auto plane = [&](int z) {
    return glm::mix(glm::mix(at(low.x, low.y, z), at(high.x, low.y, z), f.x),
                    glm::mix(at(low.x, high.y, z), at(high.x, high.y, z), f.x), f.y);
  };
  return glm::mix(plane(low.z), plane(high.z), f.z);
}

/// Where next to nothing comes through, a share of the estimates survives, with its inverse for a weight
/// (Russian roulette).
constexpr float kFaint = 0.01f, kSurvival = 0.25f;
constexpr int kCollisionsPerCheck = 8;

} // namespace

GlowTable::GlowTable(float hottest) {
  const double most = glow_luminance(static_cast<double>(hottest));
  for (int i = 0; i <= kSteps; ++i) {
    const float kelvin = hottest * static_cast<float>(i) / kSteps;
    // What is cold does not glow; its sum underflows, too.
    const double share = kelvin > 300 && most > 0 ? glow_luminance(static_cast<double>(kelvin)) / most : 0;
    glow_[static_cast<std::size_t>(i)] = blackbody_color(kelvin) * static_cast<float>(share);
  }
}

Spectrum GlowTable::operator[](float share) const {
  const float place = std::clamp(share, 0.0f, 1.0f) * kSteps;
  const auto i = static_cast<std::size_t>(std::min(place, static_cast<float>(kSteps - 1)));
  return glm::mix(glow_[i], glow_[i + 1], place - static_cast<float>(i));
}

Spectrum GridMedium::albedo_at(vec3 cell) const {
  return values->color.empty() ? albedo : albedo * value_in_grid(*values, values->color, cell);
}

Spectrum GridMedium::emitted_at(vec3 cell, Spectrum sigma_t) const {
  Spectrum light = sigma_t * (1.0f - albedo_at(cell)) * emission;
  // Where a file has no temperatures, the density says what is hot.
  if (glow)
    light *= (*glow)[values->temperature.empty() ? bricks->density(cell)
                                                 : value_in_grid(*values, values->temperature, cell)];
  return light;
}

TransmittanceEstimate GridMedium::transmittance(const Ray& ray, float distance,
                                                const Sampler& sampler) const {
  const Spectrum absorbed = glm::exp(-HomogeneousMedium::times_distance(absorption, distance));
  if (!has_matter()) return {absorbed, Spectrum(1)};
  TrackingRandom random(sampler, ray.origin, ray.direction);
  float mean_depth = 0;
  const Spectrum tracked =
      track_transmittance(ray.origin, glm::normalize(ray.direction), 0, distance, random, &mean_depth);
  return {absorbed * tracked, glm::exp(-mean_depth * density_sigma_t)};
}

Spectrum GridMedium::estimate_optical_depth(vec3 origin, vec3 direction, float distance,
                                            TrackingRandom& random) const {
  Spectrum depth = HomogeneousMedium::times_distance(absorption, distance);
  const vec3 from = to_cells(origin), along = direction * cells_per_unit;
  bricks->walk(from, along, 0, distance, [&](const BrickGrid::Place& brick, float first, float last) {
    if (!(bricks->bounds(brick).most > 0)) return true;
    const float t = glm::mix(first, last, random.next());
    depth += bricks->density(brick, from + t * along) * (last - first) * density_sigma_t;
    return true;
  });
  return depth;
}

/// With a control variate c in each brick (residual tracking: Novak, Selle & Jarosz 2014, "Residual Ratio
/// Tracking for Estimating Attenuation in Participating Media"; c = 0: ratio tracking), the estimate is
/// exp(-integral of c) x product over tentative collisions of 1 - (sigma - c) / majorant.
Spectrum GridMedium::track_transmittance(vec3 origin, vec3 direction, float begin, float end,
                                         TrackingRandom& random, float* mean_depth) const {
  const vec3 from = to_cells(origin), along = direction * cells_per_unit;
  const bool residual = estimator == TransmittanceEstimator::residual;
  const float strongest = max_component(density_sigma_t);
  const Spectrum relative = density_sigma_t / strongest;
  Spectrum passes(1);
  float known_depth = 0; // of the strongest channel
  float left = random.next_depth();
  bool ended = false;
  bricks->walk(from, along, begin, end, [&](const BrickGrid::Place& brick, float first, float last) {
    const BrickBounds& bounds = bricks->bounds(brick);
    if (mean_depth != nullptr) *mean_depth += bounds.mean * (last - first);
    if (ended) return mean_depth != nullptr;
    const float control = residual ? bounds.mean : 0;
    const float majorant = strongest * (residual ? bounds.spread : bounds.most);
    // Russian roulette, where hardly anything is left.
    auto survives = [&](float t) {
      const Spectrum known = (known_depth + strongest * control * (t - first)) * relative;
      const float so_far = max_component(glm::abs(passes) * glm::exp(-known));
      if (so_far >= kFaint) return true;
      ended = !(so_far > 0) || random.next() >= kSurvival;
      passes = ended ? Spectrum(0) : passes / kSurvival;
      return !ended;
    };
    float t = first;
    for (int collision = 1; majorant > 0 && collision <= BrickGrid::kMostCollisions; ++collision) {
      const float step = left / majorant;
      if (!(t + step < last)) {
        left = std::max(left - majorant * (last - t), 0.0f);
        break;
      }
      t += step;
      left = random.next_depth();
      const float density = bricks->density(brick, from + t * along);
      passes *= 1.0f - relative * ((density - control) * strongest / majorant);
      if (collision % kCollisionsPerCheck == 0 && !survives(t)) break;
    }
    if (!ended && survives(last)) known_depth += strongest * control * (last - first);
    return !ended || mean_depth != nullptr;
  });
  return passes * glm::exp(-known_depth * relative);
}

} // namespace candela
