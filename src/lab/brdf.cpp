#include "lab/brdf.h"

namespace candela {

namespace {

constexpr std::string_view kDirections[] = {"uniform", "cosine", "bsdf"};

const Field<BrdfOptions> kBrdfFields[] = {
    {{"theta", FieldType::angle, 0, 89.9, "degrees", "Angle between the normal and the direction of view wo"},
     [](BrdfOptions& o) -> void* { return &o.theta; }},
    {{"directions", FieldType::choice, 0, 0, "",
      "Density of the sampled directions: uniform, by the cosine, or by the material", Invalidates::image,
      kDirections},
     [](BrdfOptions& o) -> void* { return &o.sampling; }},
};

} // namespace

std::span<const Field<BrdfOptions>> brdf_fields() { return kBrdfFields; }

vec2 direction_chart(vec3 w) {
  constexpr float kBelowHalf = 0.5f - 0x1p-25f; // the last row above the surface
  const float turns = std::atan2(w.y, w.x) * (0.5f * kInvPi);
  const float theta = std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z) * kInvPi;
  // A grazing direction's angle rounds to 90 degrees: it must not change its side.
  return {turns < 0 ? turns + 1 : turns, w.z > 0 ? std::min(theta, kBelowHalf) : std::max(theta, 0.5f)};
}

vec3 direction_from_chart(vec2 q) {
  const float phi = 2 * kPi * q.x, theta = kPi * q.y;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

BrdfLesson::BrdfLesson(Bsdf bsdf, const BrdfOptions& options, SampleSource source, std::uint64_t samples)
    : bsdf_(bsdf), options_(options), source_(source), samples_(samples) {
  histogram_.grid = kGrid;
  histogram_.counts.assign(kGrid.size(), 0);
  const vec3 wo = options_.wo();
  auto density = [&](vec2 q) { // per unit of the chart: sin(theta) dtheta dphi = 2 pi^2 sin(theta) dq
    constexpr double kSquare = 2 * std::numbers::pi * std::numbers::pi;
    const vec3 wi = direction_from_chart(q);
    return static_cast<double>(direction_pdf(bsdf_, wo, wi, options_.sampling)) * kSquare *
           std::sin(std::numbers::pi * static_cast<double>(q.y));
  };
  histogram_.expected = expected_shares(kGrid, density, direction_chart(reflect_about_normal(wo)));
  // Apart from absorption, a sample fails if rounding puts its direction into the surface plane.
  constexpr double kRounding = 1e-7;
  histogram_.outside_expected = std::max(1 - histogram_.integral(), kRounding);
}

void BrdfLesson::advance(std::uint64_t count) {
  const vec3 wo = options_.wo();
  const std::uint64_t end = done_ + std::min(count, samples_ - done_);
  Sampler sampler = source_.sampler();
  for (; done_ < end; ++done_) {
    sampler.start({0, 0}, static_cast<std::uint32_t>(done_));
    const vec2 square = sampler.get_2d(Dimension::bsdf_direction);
    const float lobe = sampler.get_1d(Dimension::bsdf_lobe);
    const auto sample = sample_direction(bsdf_, wo, vec3(square, lobe), options_.sampling);
    const vec3 weight = sample ? sample->weight : vec3(0);
    for (int c = 0; c < 3; ++c) weights_[static_cast<std::size_t>(c)].add(static_cast<double>(weight[c]));
    if (sample && !sample->delta) {
      ++histogram_.counts[kGrid.cell(direction_chart(sample->wi))];
      continue;
    }
    ++histogram_.outside;
    if (!sample) {
      ++failed_;
      continue;
    }
    auto lobe_of = std::ranges::find(delta_lobes_, sample->wi, &DeltaLobe::wi);
    if (lobe_of == delta_lobes_.end()) lobe_of = delta_lobes_.insert(lobe_of, DeltaLobe{sample->wi});
    ++lobe_of->count;
    lobe_of->weight_sum += sample->weight;
  }
  histogram_.total = static_cast<double>(done_);
}

vec3 BrdfLesson::albedo() const {
  vec3 mean;
  for (int c = 0; c < 3; ++c) mean[c] = static_cast<float>(weights_[static_cast<std::size_t>(c)].mean());
  return mean;
}

vec3 BrdfLesson::albedo_error() const {
  vec3 error;
  for (int c = 0; c < 3; ++c)
    error[c] = static_cast<float>(std::sqrt(weights_[static_cast<std::size_t>(c)].variance_of_mean()));
  return error;
}

} // namespace candela
