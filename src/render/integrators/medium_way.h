#pragma once
// The way of a ray through media, from where it starts to a surface or out of the scene, and where on it
// light is scattered.

#include "media/medium.h"
#include "media/medium_stack.h"

#include <optional>
#include <span>
#include <vector>

namespace candela {

/// A part of the ray that lies in one medium, or in none.
struct MediumSegment {
  vec3 origin;          ///< where it begins
  float begin, end;     ///< distances along the ray, scene units; the last one's end may be infinite
  MediumStack bodies;   ///< that it lies in
  const Medium* medium; ///< null: nothing is there
  bool scatters;        ///< the medium, somewhere
};

/// A stretch of a segment where the coefficients are the same: all of it, or of a grid what lies in one of
/// its bricks, with the brick's mean.
struct MediumStretch {
  float begin, end;
  std::uint32_t segment;
  Spectrum sigma_t;       ///< extinction coefficient as collisions are sampled by: 0 of what does not scatter
  Spectrum transmittance; ///< of the way to its beginning
  Spectrum unscattered;   ///< as MediumPoint has it, likewise
};

/// A place on the way.
struct MediumPoint {
  float distance; ///< along the ray, scene units
  const MediumSegment* segment;
  Spectrum sigma_t;       ///< as the stretch has it
  Spectrum transmittance; ///< of the way to it, but for what grids take
  /// The same, where media that do not scatter are left out; of grids what their means take.
  Spectrum unscattered;
};

/// With what probability a random distance is that of each channel, where their extinction differs; they add
/// up to 1. The density of a distance is the mixture of the channels' (one-sample MIS with the balance
/// heuristic; Veach 1997, section 9.2.4), so that one path carries all of them. In proportion to the path's
/// throughput (Chiang et al. 2016, "Practical and Controllable Subsurface Scattering", section 4): after a
/// stretch it is then what it would have been for the whole way at once.
Spectrum channel_probabilities(Spectrum throughput);

/// The channel that u chooses, and u stretched over its interval again.
int choose_channel(Spectrum channels, float& u);

/// Kept from ray to ray, for it keeps its memory. Grids are what their bricks' means are: nothing of it is
/// random, and densities of distances are known. What the grids' own densities make of it is for
/// medium_tracking.h.
class MediumWay {
public:
  /// `whole`: also grids that hardly anything passes are followed to their end, see is_thick().
  explicit MediumWay(bool whole = false) : whole_(whole) {}
  void start(vec3 direction);
  /// The next stretch.
  void add(vec3 origin, float length, const MediumStack& bodies, const Medium* medium, bool sealed = false);

  std::span<const MediumSegment> segments() const { return segments_; }
  vec3 direction() const { return direction_; }
  bool scatters() const { return scatters_; }
  /// Whether any of it is a grid.
  bool has_grids() const { return has_grids_; }
  /// Whether grids take so much that most rays end in them. The rest of the way is not known then: distances
  /// cannot be sampled, and transmittances are wrong.
  bool is_thick() const { return thick_; }
  bool emits() const { return emits_; }
  /// Whether light samples may reach a medium that scatters.
  bool is_lit() const { return lit_; }
  /// Of all of it.
  Spectrum transmittance() const { return transmittance_; }
  Spectrum unscattered() const { return unscattered_; }
  /// Radiance that all of it sends to its start, without what it scatters and what grids send.
  Spectrum emitted() const;

  /// What lies at that distance; one stretch does. In a body whose grid ends before, nothing does.
  MediumPoint at(float distance) const;
  vec3 position(const MediumPoint& point) const {
    return point.segment->origin + (point.distance - point.segment->begin) * direction_;
  }

  // Distances of collisions, of the density (1/scene unit) p(t) = sum over channels of
  //     probability x sigma_t x exp(-integral of sigma_t up to t),
  // where sigma_t counts media that scatter alone. It integrates to 1 - the probability of no collision.

  /// u.x chooses the channel, u.y the distance. Nothing: it comes through.
  std::optional<MediumPoint> sample_collision(Spectrum channels, vec2 u) const;
  /// The same on an endless way through one medium; infinite where that is a grid.
  static float collision_distance(const Medium& medium, Spectrum channels, vec2 u);
  float collision_pdf(const MediumPoint& point, Spectrum channels) const;
  float pass_probability(Spectrum channels) const { return glm::dot(channels, unscattered_); }

  // The same for a collision that is made to happen: each channel's density is divided by its integral.

  std::optional<MediumPoint> sample_forced_collision(Spectrum channels, vec2 u) const;
  float forced_collision_pdf(const MediumPoint& point, Spectrum channels) const;

  /// About how far light goes in the first medium that scatters, scene units.
  float typical_free_path() const { return free_path_; }
  /// From where to where media scatter; what lies between may not.
  float scattering_begin() const { return scattering_begin_; }
  float scattering_end() const { return scattering_end_; }

private:
  std::optional<MediumPoint> at_depth(int channel, float optical_depth) const;
  MediumPoint point_on(const MediumStretch& stretch, float distance) const;

  void add_stretch(float begin, float end, Spectrum sigma_t, Spectrum optical_depth);
  void add_grid(const GridMedium& medium, float begin, float end);

  vec3 direction_{0};
  std::vector<MediumSegment> segments_;
  std::vector<MediumStretch> stretches_;
  bool scatters_ = false, emits_ = false, lit_ = false, has_grids_ = false, thick_ = false;
  bool whole_;
  Spectrum transmittance_{1}, unscattered_{1};
  Spectrum depth_{0}; ///< optical, of media that scatter
  float scattering_begin_ = 0, scattering_end_ = 0, free_path_ = 0;
};

/// Distances along a ray whose density is in proportion to 1 / (squared distance to a point): Kulla & Fajardo
/// 2012, "Importance Sampling Techniques for Path Tracing in Participating Media", section 3.1 (equiangular).
class EquiangularSampling {
public:
  /// Between two distances of a ray of unit direction; `end` may be infinite.
  EquiangularSampling(vec3 origin, vec3 direction, vec3 point, float begin, float end);

  /// Whether the stretch takes up enough of the view from the point for its angles to be told apart as
  /// floats. From farther away all of it is equally near, anyway.
  bool is_usable() const { return angle_end_ - angle_begin_ > kLeastAngle; }
  float sample(float u) const;
  float pdf(float distance) const; ///< 1/scene unit

private:
  static constexpr float kLeastAngle = 1e-3f;    ///< radians
  static constexpr float kSteepest = 1.5707960f; ///< below a right angle, whose tangent changes its sign

  float begin_, end_;
  float nearest_; ///< distance along the ray of what is nearest to the point
  float height_;  ///< of the point over that
  float angle_begin_, angle_end_;
};

} // namespace candela
