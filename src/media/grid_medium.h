#pragma once

#include "media/brick_grid.h"
#include "media/homogeneous_medium.h"

#include <array>
#include <optional>

namespace candela {

/// How the transmittance of grids is estimated; both without bias.
enum class TransmittanceEstimator : int {
  residual, ///< residual tracking: the mean of each brick is known, and only what differs from it is
            ///< estimated
  ratio,    ///< ratio tracking: each meeting with possible matter lets its share pass
};

/// What black bodies send out by their temperature, relative to the hottest: by Planck's law, with the colour
/// of each and its share of the luminance.
class GlowTable {
public:
  explicit GlowTable(float hottest); ///< kelvin
  /// By the share of the hottest one's temperature, in [0, 1].
  Spectrum operator[](float share) const;

private:
  static constexpr int kSteps = 256;
  std::array<Spectrum, kSteps + 1> glow_;
};

/// Coefficients that a grid of densities scales.
struct GridMedium {
  std::shared_ptr<const VolumeGrid> values; ///< never null
  std::shared_ptr<const BrickGrid> bricks;  ///< of them; never null
  vec3 cells_per_unit, first_cell; ///< a place p of the world is p * cells_per_unit - first_cell in cells
  Spectrum density_sigma_t{1};     ///< extinction coefficient where the density is 1, 1/scene unit
  Spectrum albedo{1};              ///< times the grid's colour
  Spectrum absorption{0};          ///< added to it all over the body, 1/scene unit
  Spectrum emission{0};            ///< as HomogeneousMedium has it, where it is hottest
  std::shared_ptr<const GlowTable> glow; ///< null: the emission does not depend on the temperature
  PhaseFunction phase{};
  TransmittanceEstimator estimator = TransmittanceEstimator::residual;

  bool scatters() const { return has_matter() && max_component(albedo) > 0; }
  bool emits() const { return has_matter() && max_component(emission * (1.0f - albedo * darkest())) > 0; }
  bool has_matter() const { return !bricks->is_empty() && max_component(density_sigma_t) > 0; }

  vec3 to_cells(vec3 place) const { return place * cells_per_unit - first_cell; }
  Spectrum albedo_at(vec3 cell) const;
  /// What it sends out in the place, 1/scene unit x W/(m^2 sr), where its extinction is `sigma_t`.
  Spectrum emitted_at(vec3 cell, Spectrum sigma_t) const;
  /// Scattering coefficient at a place of the world, 1/scene unit.
  Spectrum sigma_s_at(vec3 place) const {
    const vec3 cell = to_cells(place);
    return bricks->density(cell) * density_sigma_t * albedo_at(cell);
  }

  TransmittanceEstimate transmittance(const Ray& ray, float distance, const Sampler& sampler) const;

  Spectrum estimate_optical_depth(vec3 origin, vec3 direction, float distance, TrackingRandom& random) const;

  /// The estimate of the grid's transmittance between two distances along a ray of unit direction, without
  /// `absorption`. `mean_depth`, if not null, grows by the integral of the bricks' mean densities.
  Spectrum track_transmittance(vec3 origin, vec3 direction, float begin, float end, TrackingRandom& random,
                               float* mean_depth = nullptr) const;

private:
  /// A factor of the albedo that none in the grid is below.
  float darkest() const { return values->color.empty() ? 1.0f : 0.0f; }
};

} // namespace candela
