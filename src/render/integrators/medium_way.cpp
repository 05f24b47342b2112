#include "render/integrators/medium_way.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Extinction coefficient as collisions are sampled by: 0 of what does not scatter.
Spectrum sampled_sigma_t(const MediumStretch& stretch) {
  if (stretch.medium == nullptr) return Spectrum(0);
  return visit_variant([](const auto& m) { return m.scatters() ? m.sigma_t() : Spectrum(0); },
                       *stretch.medium);
}

Spectrum optical_depth(const MediumStretch& stretch, float length) {
  if (stretch.medium == nullptr) return Spectrum(0);
  return visit_variant([&](const auto& m) { return m.optical_depth(length); }, *stretch.medium);
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
}

void MediumWay::add(vec3 origin, float length, const MediumStack& bodies, const Medium* medium, bool sealed) {
  const float begin = stretches_.empty() ? 0 : stretches_.back().end, end = begin + length;
  stretches_.push_back({origin, begin, end, bodies, medium, sealed});
  if (medium == nullptr) return;
  const Spectrum passes = glm::exp(-optical_depth(stretches_.back(), length));
  transmittance_ *= passes;
  emits_ |= medium_emits(*medium);
  if (!medium_scatters(*medium)) return;
  unscattered_ *= passes;
  if (!scatters_) scattering_begin_ = begin;
  scattering_end_ = end;
  scatters_ = true;
  lit_ |= !sealed;
}

Spectrum MediumWay::emitted() const {
  Spectrum light(0), passes(1);
  for (const MediumStretch& stretch : stretches_) {
    if (stretch.medium == nullptr) continue;
    const float length = stretch.end - stretch.begin;
    light += passes * visit_variant([&](const auto& m) { return m.emitted(length); }, *stretch.medium);
    passes *= glm::exp(-optical_depth(stretch, length));
  }
  return light;
}

MediumPoint MediumWay::at(float distance) const {
  MediumPoint point{distance, &stretches_.front(), Spectrum(1), Spectrum(1)};
  for (const MediumStretch& stretch : stretches_) {
    point.stretch = &stretch;
    const float length = std::min(distance, stretch.end) - stretch.begin;
    const Spectrum passes = glm::exp(-optical_depth(stretch, length));
    point.transmittance *= passes;
    if (stretch.medium != nullptr && medium_scatters(*stretch.medium)) point.unscattered *= passes;
    if (distance < stretch.end) break;
  }
  return point;
}

std::optional<MediumPoint> MediumWay::at_depth(int channel, float depth) const {
  for (const MediumStretch& stretch : stretches_) {
    const float sigma = sampled_sigma_t(stretch)[channel];
    if (!(sigma > 0)) continue;
    const float length = depth / sigma;
    if (length < stretch.end - stretch.begin) {
      MediumPoint point = at(stretch.begin + length);
      point.stretch = &stretch; // also where the sum is rounded to its end
      return point;
    }
    depth -= sigma * (stretch.end - stretch.begin);
    if (!(depth >= 0)) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<MediumPoint> MediumWay::sample_collision(Spectrum channels, vec2 u) const {
  const int channel = choose_channel(channels, u.x);
  return at_depth(channel, -std::log1p(-u.y));
}

float MediumWay::collision_distance(const Medium& medium, Spectrum channels, vec2 u) {
  const int channel = choose_channel(channels, u.x);
  const float sigma = visit_variant([](const auto& m) { return m.sigma_t(); }, medium)[channel];
  return sigma > 0 ? -std::log1p(-u.y) / sigma : kInfinity;
}

float MediumWay::collision_pdf(const MediumPoint& point, Spectrum channels) const {
  return glm::dot(channels, sampled_sigma_t(*point.stretch) * point.unscattered);
}

std::optional<MediumPoint> MediumWay::sample_forced_collision(Spectrum channels, vec2 u) const {
  const int channel = choose_channel(channels, u.x);
  float depth = 0; // 1 - exp(-depth) is better known by the depth itself where it is small
  for (const MediumStretch& stretch : stretches_)
    if (stretch.medium != nullptr && medium_scatters(*stretch.medium))
      depth += optical_depth(stretch, stretch.end - stretch.begin)[channel];
  if (!(depth > 0)) return std::nullopt;
  return at_depth(channel, -std::log1p(u.y * std::expm1(-depth)));
}

float MediumWay::forced_collision_pdf(const MediumPoint& point, Spectrum channels) const {
  Spectrum depth(0);
  for (const MediumStretch& stretch : stretches_)
    if (stretch.medium != nullptr && medium_scatters(*stretch.medium))
      depth += optical_depth(stretch, stretch.end - stretch.begin);
  const Spectrum density = channels * sampled_sigma_t(*point.stretch) * point.unscattered;
  float pdf = 0;
  for (int c = 0; c < 3; ++c)
    if (depth[c] > 0) pdf += density[c] / -std::expm1(-depth[c]);
  return pdf;
}

EquiangularSampling::EquiangularSampling(vec3 origin, vec3 direction, vec3 point, float begin, float end)
    : begin_(begin), end_(end), nearest_(glm::dot(point - origin, direction)),
      height_(glm::length(point - origin - nearest_ * direction)) {
  // On the ray itself the density would have a pole.
  constexpr float kLeast = 1e-4f;
  height_ = std::max(height_, kLeast * std::abs(nearest_) + std::numeric_limits<float>::min());
  angle_begin_ = std::atan2(begin - nearest_, height_);
  angle_end_ = std::min(std::atan2(end - nearest_, height_), kSteepest);
}

float EquiangularSampling::sample(float u) const {
  const float angle = std::min(angle_begin_ + u * (angle_end_ - angle_begin_), kSteepest);
  return std::clamp(nearest_ + height_ * std::tan(angle), begin_, end_);
}

float EquiangularSampling::pdf(float distance) const {
  return height_ / ((angle_end_ - angle_begin_) * (sqr(height_) + sqr(distance - nearest_)));
}

} // namespace candela
