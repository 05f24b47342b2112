#include "render/integrators/medium_way.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Where less than about a third passes grids, light is better sampled where paths collide.
constexpr float kThickDepth = 1;

/// exp(-depth); that of grey media is computed once.
Spectrum passed(Spectrum depth) {
  if (depth.x == depth.y && depth.x == depth.z) return Spectrum(std::exp(-depth.x));
  return glm::exp(-depth);
}

/// 1 - exp(-depth), where exp(-depth) is known.
float absorbed(float depth, float passes) {
  constexpr float kThin = 0.05f; // a series beyond: digits would cancel
  return depth < kThin ? depth * (1 - depth / 2 * (1 - depth / 3 * (1 - depth / 4))) : 1 - passes;
}

/// -log(1 - x) for x in [0, 1).
float depth_of_absorbed(float x) {
  constexpr float kThin = 0.02f;
  return x < kThin ? x * (1 + x * (1.0f / 2 + x * (1.0f / 3 + x * (1.0f / 4)))) : -std::log(1 - x);
}

} // namespace

Spectrum channel_probabilities(Spectrum throughput) {
  const Spectrum weight = glm::max(throughput, Spectrum(0));
  const float sum = weight.x + weight.y + weight.z;
  return sum > 0 && std::isfinite(sum) ? weight / sum : Spectrum(1.0f / 3);
}

int choose_channel(Spectrum channels, float& u) {
  for (int c = 0; c < 2; ++c) {
    if (u < channels[c]) {
      u /= channels[c];
      return c;
    }
    u -= channels[c];
  }
  for (int c = 2; c > 0; --c) // by rounding u may be left for a channel that has no share
    if (channels[c] > 0) {
      u = std::clamp(u / channels[c], 0.0f, kOneMinusEpsilon);
      return c;
    }
  return 0;
}

void MediumWay::start(vec3 direction) {
  direction_ = direction;
  segments_.clear();
  stretches_.clear();
  scatters_ = emits_ = lit_ = has_grids_ = thick_ = false;
  transmittance_ = unscattered_ = Spectrum(1);
  depth_ = Spectrum(0);
}

void MediumWay::add(vec3 origin, float length, const MediumStack& bodies, const Medium* medium, bool sealed) {
  const float begin = segments_.empty() ? 0 : segments_.back().end, end = begin + length;
  const bool scatters = medium != nullptr && medium_scatters(*medium);
  segments_.push_back({origin, begin, end, bodies, medium, scatters});
  if (medium == nullptr) return add_stretch(begin, end, Spectrum(0), Spectrum(0));
  emits_ |= medium_emits(*medium);
  if (const auto* grid = std::get_if<GridMedium>(medium)) {
    add_grid(*grid, begin, end);
  } else {
    const auto& uniform = std::get<HomogeneousMedium>(*medium);
    add_stretch(begin, end, scatters ? uniform.sigma_t() : Spectrum(0), uniform.optical_depth(length));
  }
  lit_ |= scatters && !sealed;
}

/// `optical_depth` is that of all that is known to happen on the stretch.
void MediumWay::add_stretch(float begin, float end, Spectrum sigma_t, Spectrum optical_depth) {
  const auto segment = static_cast<std::uint32_t>(segments_.size() - 1);
  stretches_.push_back({begin, end, segment, sigma_t, transmittance_, unscattered_});
  if (segments_.back().medium == nullptr) return;
  const Spectrum passes = passed(optical_depth);
  const bool scatters = max_component(sigma_t) > 0;
  const bool known = !std::holds_alternative<GridMedium>(*segments_.back().medium);
  if (known) transmittance_ *= passes;
  if (!scatters) return;
  unscattered_ *= passes;
  depth_ += optical_depth;
  if (!scatters_) {
    scattering_begin_ = begin;
    free_path_ = 1 / average(sigma_t);
  }
  scattering_end_ = end;
  scatters_ = true;
}

/// Its bricks that hold anything, and what is between them.
void MediumWay::add_grid(const GridMedium& medium, float begin, float end) {
  has_grids_ = true;
  const MediumSegment& segment = segments_.back();
  const vec3 along = direction_ * medium.cells_per_unit;
  const vec3 from = medium.to_cells(segment.origin) - begin * along; // at the distance 0
  float reached = begin;
  if (medium.has_matter() && !thick_)
    medium.bricks->walk(from, along, begin, end, [&](const BrickGrid::Place& brick, float first, float last) {
      const float mean = medium.bricks->bounds(brick).mean;
      if (!(mean > 0)) return true;
      if (first > reached) add_stretch(reached, first, Spectrum(0), Spectrum(0));
      const Spectrum sigma_t = segment.scatters ? mean * medium.density_sigma_t : Spectrum(0);
      add_stretch(first, last, sigma_t, sigma_t * (last - first));
      reached = last;
      thick_ = !whole_ && average(depth_) > kThickDepth;
      return !thick_;
    });
  add_stretch(reached, end, Spectrum(0), Spectrum(0));
  transmittance_ *= passed(HomogeneousMedium::times_distance(medium.absorption, end - begin));
}

Spectrum MediumWay::emitted() const {
  Spectrum light(0);
  for (const MediumStretch& stretch : stretches_) {
    const Medium* medium = segments_[stretch.segment].medium;
    if (medium == nullptr) continue;
    if (const auto* uniform = std::get_if<HomogeneousMedium>(medium))
      light += stretch.transmittance * uniform->emitted(stretch.end - stretch.begin);
  }
  return light;
}

MediumPoint MediumWay::point_on(const MediumStretch& stretch, float distance) const {
  const MediumSegment& segment = segments_[stretch.segment];
  const float length = distance - stretch.begin;
  Spectrum transmittance = stretch.transmittance;
  const Spectrum passes = passed(HomogeneousMedium::times_distance(stretch.sigma_t, length));
  if (segment.medium != nullptr) {
    if (const auto* uniform = std::get_if<HomogeneousMedium>(segment.medium))
      transmittance *= segment.scatters ? passes : passed(uniform->optical_depth(length));
    else
      transmittance *= passed(std::get<GridMedium>(*segment.medium).absorption * (distance - segment.begin));
  }
  return {distance, &segment, stretch.sigma_t, transmittance, stretch.unscattered * passes};
}

MediumPoint MediumWay::at(float distance) const {
  const auto found =
      std::ranges::find_if(stretches_, [&](const MediumStretch& stretch) { return distance < stretch.end; });
  const MediumStretch& stretch = found != stretches_.end() ? *found : stretches_.back();
  return point_on(stretch, std::min(distance, stretch.end));
}

std::optional<MediumPoint> MediumWay::at_depth(int channel, float depth) const {
  for (const MediumStretch& stretch : stretches_) {
    const float sigma = stretch.sigma_t[channel];
    if (!(sigma > 0)) continue;
    const float length = depth / sigma;
    if (length < stretch.end - stretch.begin) return point_on(stretch, stretch.begin + length);
    depth -= sigma * (stretch.end - stretch.begin);
    if (!(depth >= 0)) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<MediumPoint> MediumWay::sample_collision(Spectrum channels, vec2 u) const {
  const int channel = choose_channel(channels, u.x);
  return at_depth(channel, depth_of_absorbed(u.y));
}

float MediumWay::collision_distance(const Medium& medium, Spectrum channels, vec2 u) {
  const int channel = choose_channel(channels, u.x);
  const auto* uniform = std::get_if<HomogeneousMedium>(&medium);
  const float sigma = uniform != nullptr ? uniform->sigma_t()[channel] : 0;
  return sigma > 0 ? depth_of_absorbed(u.y) / sigma : kInfinity;
}

float MediumWay::collision_pdf(const MediumPoint& point, Spectrum channels) const {
  return glm::dot(channels, point.sigma_t * point.unscattered);
}

std::optional<MediumPoint> MediumWay::sample_forced_collision(Spectrum channels, vec2 u) const {
  const int channel = choose_channel(channels, u.x);
  if (!(depth_[channel] > 0)) return std::nullopt;
  return at_depth(channel, depth_of_absorbed(u.y * absorbed(depth_[channel], unscattered_[channel])));
}

float MediumWay::forced_collision_pdf(const MediumPoint& point, Spectrum channels) const {
  const Spectrum density = channels * point.sigma_t * point.unscattered;
  float pdf = 0;
  for (int c = 0; c < 3; ++c)
    if (depth_[c] > 0) pdf += density[c] / absorbed(depth_[c], unscattered_[c]);
  return pdf;
}

EquiangularSampling::EquiangularSampling(vec3 origin, vec3 direction, vec3 point, float begin, float end)
    : begin_(begin), end_(end), nearest_(glm::dot(point - origin, direction)),
      height_(glm::length(point - origin - nearest_ * direction)) {
  // On the ray itself the density would have a pole.
  constexpr float kLeast = 1e-4f;
  height_ = std::max(height_, kLeast * std::abs(nearest_) + std::numeric_limits<float>::min());
  angle_begin_ = std::atan((begin - nearest_) / height_);
  angle_end_ = std::min(std::atan((end - nearest_) / height_), kSteepest);
}

float EquiangularSampling::sample(float u) const {
  const float angle = std::min(angle_begin_ + u * (angle_end_ - angle_begin_), kSteepest);
  return std::clamp(nearest_ + height_ * std::tan(angle), begin_, end_);
}

float EquiangularSampling::pdf(float distance) const {
  return height_ / ((angle_end_ - angle_begin_) * (sqr(height_) + sqr(distance - nearest_)));
}

} // namespace candela
