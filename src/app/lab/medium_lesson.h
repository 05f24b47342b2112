#pragma once
// The lesson `medium`: light walks through a slab of matter, free flight by free flight, and what becomes of
// it is counted against theory.

#include "app/figures/plot.h"
#include "core/fields.h"
#include "core/statistics.h"
#include "lab/source.h"
#include "media/medium_desc.h"

namespace candela {

struct MediumLessonOptions {
  float optical_depth = 1; ///< of the slab, along its normal
  float albedo = 0.9f;     ///< of each collision
  float theta = 0;         ///< radians, between the light that falls in and the normal
  int phase = 0;           ///< type of phase function, as phase_type_field() has it
  float g = 0.5f;          ///< of Henyey and Greenstein's
  float diameter = 15;     ///< of droplets, micrometres
  bool operator==(const MediumLessonOptions&) const = default;

  PhaseFunction phase_function() const;
};
std::span<const Field<MediumLessonOptions>> medium_lesson_fields();
/// Whether the row says anything of the chosen phase function.
bool medium_lesson_uses(const MediumLessonOptions& options, std::string_view key);

/// Shares of the light that falls on a slab.
struct SlabShares {
  double reflected = 0;
  double transmitted = 0; ///< after it was scattered
  double direct = 0;      ///< without being scattered: exp(-optical depth / cos(theta))
  double absorbed = 0;
};

/// Of isotropic scattering, in plane geometry, light coming at the cosine mu0: the integral equation
///     S(t) = omega / 2 x integral of S(t') E1(|t - t'|) dt' + omega / (4 pi mu0) exp(-t / mu0)
/// (Chandrasekhar 1960, "Radiative Transfer", section 11 and 13), solved on cells of constant S.
SlabShares isotropic_slab(double optical_depth, double albedo, double mu0);

/// Follows light as path tracing does, with the dimensions medium_distance and bsdf_direction of a bounce for
/// each flight. A value.
class MediumLesson {
public:
  MediumLesson(const MediumLessonOptions& options, SampleSource source, std::uint64_t samples);

  const MediumLessonOptions& options() const { return options_; }
  const SampleSource& source() const { return source_; }
  std::uint64_t samples() const { return samples_; }
  std::uint64_t done() const { return done_; }
  bool finished() const { return done_ >= samples_; }
  void advance(std::uint64_t count);

  SlabShares counted() const;
  /// Standard error of a counted share, as if the samples were independent.
  double error(double share) const;
  /// Exact where light scatters into all directions alike, else of the slab that is alike by the similarity
  /// of phase functions (van de Hulst 1980, "Multiple Light Scattering", chapter 14): omega' = omega (1 - g)
  /// / (1 - omega g), depth' = depth (1 - omega g); direct light is exact.
  const SlabShares& theory() const { return theory_; }
  bool theory_is_exact() const { return exact_; }
  double mean_scatterings() const { return scatterings_.mean(); }
  double mean_flight() const { return flights_.mean(); } ///< optical, of the first flights
  /// The first flights counted by their optical length, as a density, and exp(-length).
  Plot flight_plot() const;
  /// Shares of the light by how often it was scattered before it left.
  Plot order_plot() const;

private:
  static constexpr std::size_t kFlightBins = 40, kOrders = 24;
  static constexpr float kLongestFlight = 6; ///< of the plot, optical

  MediumLessonOptions options_;
  SampleSource source_;
  std::uint64_t samples_, done_ = 0;
  std::uint64_t reflected_ = 0, transmitted_ = 0, direct_ = 0, absorbed_ = 0;
  RunningStatistics scatterings_, flights_;
  std::array<std::uint64_t, kFlightBins> flight_counts_{};
  std::array<std::uint64_t, kOrders> reflected_by_order_{}, transmitted_by_order_{};
  SlabShares theory_;
  bool exact_;
};

} // namespace candela
