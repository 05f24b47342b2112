#include "render/integrators/medium_way.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Extinction coefficient as collisions are sampled by: 0 of what does not scatter.
Spectrum sampled_sigma_t(const MediumStretch& stretch) {
  if (!stretch.scatters) return Spectrum(0);
  return visit_variant([](const auto& m) { return m.sigma_t(); }, *stretch.medium);
}

Spectrum optical_depth(const MediumStretch& stretch, float length) {
  if (stretch.medium == nullptr) return Spectrum(0);
  return visit_variant([&](const auto& m) { return m.optical_depth(length); }, *stretch.medium);
}

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

/// The channel that u chooses, and u stretched over its interval again.
int choose_channel(Spectrum channels, float& u) {
  for (int c = 0; c < 2; ++c) {
    if (u < channels[c]) {
      u /= channels[c];
      return c;
    }
    u -= channels[c];
  }
  return 2;
}

} // namespace

Spectrum channel_probabilities(Spectrum throughput) {
  const Spectrum weight = glm::max(throughput, Spectrum(0));
  const float sum = weight.x + weight.y + weight.z;
  return sum > 0 && std::isfinite(sum) ? weight / sum : Spectrum(1.0f / 3);
}

void MediumWay::start(vec3 direction) {
  direction_ = direction;
  stretches_.clear();
  scatters_ = emits_ = lit_ = false;
  transmittance_ = unscattered_ = Spectrum(1);
  depth_ = Spectrum(0);
}

void MediumWay::add(vec3 origin, float length, const MediumStack& bodies, const Medium* medium, bool sealed) {
  const float begin = stretches_.empty() ? 0 : stretches_.back().end, end = begin + length;
  const bool scatters = medium != nullptr && medium_scatters(*medium);
  stretches_.push_back({origin, begin, end, bodies, medium, scatters, transmittance_, unscattered_});
  if (medium == nullptr) return;
  const Spectrum depth = optical_depth(stretches_.back(), length), passes = passed(depth);
  transmittance_ *= passes;
  emits_ |= medium_emits(*medium);
  if (!scatters) return;
  unscattered_ *= passes;
  depth_ += depth;
  if (!scatters_) {
    scattering_begin_ = begin;
    free_path_ = 1 / average(visit_variant([](const auto& m) { return m.sigma_t(); }, *medium));
  }
  scattering_end_ = end;
  scatters_ = true;
  lit_ |= !sealed;
}

Spectrum MediumWay::emitted() const {
  Spectrum light(0);
  for (const MediumStretch& stretch : stretches_) {
    if (stretch.medium == nullptr) continue;
    const float length = stretch.end - stretch.begin;
    light += stretch.transmittance *
             visit_variant([&](const auto& m) { return m.emitted(length); }, *stretch.medium);
  }
  return light;
}

MediumPoint MediumWay::point_on(const MediumStretch& stretch, float distance) const {
  const Spectrum passes = passed(optical_depth(stretch, distance - stretch.begin));
  return {distance, &stretch, stretch.transmittance * passes,
          stretch.scatters ? stretch.unscattered * passes : stretch.unscattered};
}

MediumPoint MediumWay::at(float distance) const {
  const auto found =
      std::ranges::find_if(stretches_, [&](const MediumStretch& stretch) { return distance < stretch.end; });
  const MediumStretch& stretch = found != stretches_.end() ? *found : stretches_.back();
  return point_on(stretch, std::min(distance, stretch.end));
}

std::optional<MediumPoint> MediumWay::at_depth(int channel, float depth) const {
  for (const MediumStretch& stretch : stretches_) {
    if (!stretch.scatters) continue;
    const float sigma = sampled_sigma_t(stretch)[channel];
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
  const float sigma = visit_variant([](const auto& m) { return m.sigma_t(); }, medium)[channel];
  return sigma > 0 ? depth_of_absorbed(u.y) / sigma : kInfinity;
}

float MediumWay::collision_pdf(const MediumPoint& point, Spectrum channels) const {
  return glm::dot(channels, sampled_sigma_t(*point.stretch) * point.unscattered);
}

std::optional<MediumPoint> MediumWay::sample_forced_collision(Spectrum channels, vec2 u) const {
  const int channel = choose_channel(channels, u.x);
  if (!(depth_[channel] > 0)) return std::nullopt;
  return at_depth(channel, depth_of_absorbed(u.y * absorbed(depth_[channel], unscattered_[channel])));
}

float MediumWay::forced_collision_pdf(const MediumPoint& point, Spectrum channels) const {
  const Spectrum density = channels * sampled_sigma_t(*point.stretch) * point.unscattered;
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
