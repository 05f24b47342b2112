#include "render/integrators/medium_tracking.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// State of track().
struct RayTracking {
  const MediumWay& way;
  bool collides;
  TrackingRandom& random;
  Spectrum density_of_channels; ///< q x the channels' probabilities
  Spectrum contribution{1};     ///< f
  Spectrum mean_depth{0};       ///< optical, of what scatters, by the bricks' means
  TrackedWay out{};

  float density_sum() const { return density_of_channels.x + density_of_channels.y + density_of_channels.z; }
  /// Of the path that has come so far.
  Spectrum weight() const {
    if (!collides) return contribution;
    const float sum = density_sum();
    return sum > 0 ? contribution / sum : Spectrum(0);
  }

  bool follow(const MediumSegment& segment, const HomogeneousMedium& medium);
  bool follow(const MediumSegment& segment, const GridMedium& medium);
  bool follow_brick(const MediumSegment& segment, const GridMedium& medium, const BrickGrid::Place& brick,
                    float first, float last);
  static Spectrum absorbed_to(const MediumSegment& segment, const GridMedium& medium, float t) {
    return glm::exp(-HomogeneousMedium::times_distance(medium.absorption, t - segment.begin));
  }
  vec3 cell_at(const MediumSegment& segment, const GridMedium& medium, float t) const {
    return medium.to_cells(segment.origin + (t - segment.begin) * way.direction());
  }
  /// Ends the path there: `scattered` is f of it, `pdf` its density_of_channels.
  void collide(const MediumSegment& segment, float t, Spectrum scattered, float pdf) {
    out.collision = {&segment, t, segment.origin + (t - segment.begin) * way.direction(),
                     pdf > 0 ? scattered / pdf : Spectrum(0)};
  }

  float left = 0; ///< of the optical depth to the next tentative collision in grids
};

// Whether the path continues behind the segment or brick:

bool RayTracking::follow(const MediumSegment& segment, const HomogeneousMedium& medium) {
  const float length = segment.end - segment.begin;
  if (medium.emits()) out.emitted += weight() * medium.emitted(length);
  const Spectrum passes = glm::exp(-medium.optical_depth(length));
  if (!segment.scatters) {
    contribution *= passes;
    return true;
  }
  const Spectrum sigma_t = medium.sigma_t();
  mean_depth += medium.optical_depth(length);
  if (collides) {
    const float sum = density_sum(), through = glm::dot(density_of_channels, passes) / sum;
    if (!(random.next() < through)) {
      float u = random.next();
      const int channel = choose_channel(density_of_channels * (1.0f - passes) / (sum * (1 - through)), u);
      // Of the depth before the end, by inversion.
      const float absorbed = -std::expm1(-sigma_t[channel] * length);
      const float t = std::min(-std::log1p(-u * absorbed) / sigma_t[channel], length);
      const Spectrum at = glm::exp(-sigma_t * t);
      collide(segment, segment.begin + t, contribution * at * medium.sigma_s,
              glm::dot(density_of_channels, sigma_t * at));
      return false;
    }
  }
  contribution *= passes;
  density_of_channels *= passes;
  return true;
}

bool RayTracking::follow(const MediumSegment& segment, const GridMedium& medium) {
  if (medium.has_matter()) {
    const vec3 along = way.direction() * medium.cells_per_unit;
    const vec3 from = medium.to_cells(segment.origin) - segment.begin * along; // at the distance 0
    left = random.next_depth();
    medium.bricks->walk(from, along, segment.begin, segment.end,
                        [&](const BrickGrid::Place& brick, float first, float last) {
                          return follow_brick(segment, medium, brick, first, last);
                        });
  }
  if (out.collision) {
    out.collision->weight *= absorbed_to(segment, medium, out.collision->distance);
    return false;
  }
  contribution *= absorbed_to(segment, medium, segment.end);
  return max_component(contribution) > 0;
}

bool RayTracking::follow_brick(const MediumSegment& segment, const GridMedium& medium,
                               const BrickGrid::Place& brick, float first, float last) {
  const BrickBounds& bounds = medium.bricks->bounds(brick);
  if (!(bounds.most > 0)) return true;
  if (segment.scatters) mean_depth += bounds.mean * (last - first) * medium.density_sigma_t;
  // Where no collision ends the path, its transmittance is estimated as GridMedium does.
  const bool estimates = !segment.scatters || !collides;
  const bool residual = estimates && medium.estimator == TransmittanceEstimator::residual;
  const float control = residual ? bounds.mean : 0;
  const float majorant = (residual ? bounds.spread : bounds.most) * max_component(medium.density_sigma_t);
  // Emission is looked for at one place of each brick, however thin it is.
  float shines_at = medium.emits() ? first + random.next() * (last - first) : kInfinity;
  // What the mean takes, step by step: of much matter at once the product below could overflow.
  float known_to = first;
  auto apply_known = [&](float to) {
    if (residual) contribution *= glm::exp(-control * (to - known_to) * medium.density_sigma_t);
    known_to = to;
  };
  float t = first;
  for (int collisions = 0;; ++collisions) {
    const bool may_collide = majorant > 0 && collisions < BrickGrid::kMostCollisions;
    const float next = may_collide ? t + left / majorant : kInfinity;
    if (shines_at < std::min(next, last)) {
      const vec3 cell = cell_at(segment, medium, shines_at);
      const Spectrum sigma_t = medium.bricks->density(brick, cell) * medium.density_sigma_t;
      apply_known(shines_at);
      out.emitted += weight() * absorbed_to(segment, medium, shines_at) * medium.emitted_at(cell, sigma_t) *
                     (last - first);
      shines_at = kInfinity;
    }
    if (!(next < last)) {
      left = std::max(left - majorant * (last - t), 0.0f);
      apply_known(last);
      return true;
    }
    t = next;
    left = random.next_depth();
    const vec3 cell = cell_at(segment, medium, t);
    const float density = medium.bricks->density(brick, cell);
    const Spectrum real = (density - control) / majorant * medium.density_sigma_t;
    if (estimates) {
      apply_known(t);
      contribution *= 1.0f - glm::min(real, Spectrum(1));
      if (!(max_component(glm::abs(contribution)) > 0)) return false;
      continue;
    }
    const float sum = density_sum(), pdf = glm::dot(density_of_channels, real);
    if (random.next() * sum < pdf) {
      collide(segment, t, contribution * real * medium.albedo_at(cell), pdf);
      return false;
    }
    // By rounding an extinction may be above its majorant.
    const Spectrum passes = glm::max(1.0f - real, Spectrum(0));
    contribution *= passes;
    density_of_channels *= passes;
    const float scale = density_sum(); // only their ratios matter
    if (!(scale > 0)) return false;
    contribution /= scale, density_of_channels /= scale;
  }
}

} // namespace

TrackedWay track(const MediumWay& way, Spectrum channels, bool collides, TrackingRandom& random) {
  RayTracking tracking{way, collides, random, channels};
  for (const MediumSegment& segment : way.segments()) {
    if (segment.medium == nullptr) continue;
    const bool continues =
        visit_variant([&](const auto& medium) { return tracking.follow(segment, medium); }, *segment.medium);
    if (continues) continue;
    if (!tracking.out.collision) tracking.contribution = Spectrum(0);
    break;
  }
  tracking.out.weight = tracking.weight();
  tracking.out.unscattered = glm::exp(-tracking.mean_depth);
  return tracking.out;
}

Spectrum track_transmittance(const MediumWay& way, float distance, TrackingRandom& random) {
  Spectrum passes(1);
  for (const MediumSegment& segment : way.segments()) {
    if (segment.begin >= distance) break;
    if (segment.medium == nullptr) continue;
    const auto* grid = std::get_if<GridMedium>(segment.medium);
    if (grid == nullptr || !grid->has_matter()) continue;
    // Distances are along the whole ray there.
    const vec3 start = segment.origin - segment.begin * way.direction();
    passes *= grid->track_transmittance(start, way.direction(), segment.begin,
                                        std::min(segment.end, distance), random);
  }
  return passes;
}

} // namespace candela
