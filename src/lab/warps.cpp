#include "lab/warps.h"

#include "sampling/warp.h"

namespace candela {

namespace {

constexpr std::string_view kWarps[] = {"disc", "sphere",   "hemisphere",          "cosine_hemisphere",
                                       "cone", "triangle", "spherical_rectangle", "gaussian"};

const Field<WarpOptions> kWarpFields[] = {
    {{"warp", FieldType::choice, 0, 0, "", "The map of the unit square", Invalidates::image, kWarps},
     [](WarpOptions& o) -> void* { return &o.warp; }},
    {{"cone_angle", FieldType::angle, 0.1, 180, "degrees", "From the cone's axis to its edge"},
     [](WarpOptions& o) -> void* { return &o.cone_angle; }},
    {{"grid", FieldType::integer, 2, 128, "cells", "Cells a side of the histogram"},
     [](WarpOptions& o) -> void* { return &o.grid; }},
};

// The rectangle's corner and edges; off centre and near, so that solid angle and area differ strongly.
const vec3 kCorner(-1.2f, -0.6f, 0.5f), kEdgeX(2, 0, 0), kEdgeY(0, 1.6f, 0);
// The triangle's corners, those of b0, b1 and b2 = 1 - b0 - b1.
const vec3 kA(0), kB(1, 0, 0), kC(0.5f, 0.8660254f, 0);
constexpr double kTriangleArea = 0.4330127018922193;
constexpr float kGaussianSigma = 1.0f / 3,
                kGaussianRadius = 1; // like the pixel filter: sigma is a third of the radius
const TruncatedGaussian kGaussian(kGaussianSigma, kGaussianRadius);

float cap_of(const WarpOptions& options) {
  switch (options.warp) {
  case Warp::sphere: return 2;
  case Warp::cone: return 2 * sqr(std::sin(0.5f * options.cone_angle)); // 1 - cos without cancellation
  default: return 1;
  }
}

float turns(float x, float y) { // azimuth in [0, 1)
  const float phi = std::atan2(y, x) * (0.5f * kInvPi);
  return phi < 0 ? phi + 1 : phi;
}

} // namespace

std::span<const Field<WarpOptions>> warp_fields() { return kWarpFields; }

bool warp_uses(Warp warp, std::string_view key) { return key != "cone_angle" || warp == Warp::cone; }

WarpMap::WarpMap(const WarpOptions& options)
    : options_(options), one_minus_cos_max_(cap_of(options)), rectangle_(kCorner, kEdgeX, kEdgeY, vec3(0)) {}

bool WarpMap::on_sphere() const {
  switch (options_.warp) {
  case Warp::sphere:
  case Warp::hemisphere:
  case Warp::cosine_hemisphere:
  case Warp::cone: return true;
  default: return false;
  }
}

vec3 WarpMap::map(vec2 u) const {
  switch (options_.warp) {
  case Warp::disc: return vec3(sample_uniform_disc(u), 0);
  case Warp::sphere: return sample_uniform_sphere(u);
  case Warp::hemisphere: return sample_uniform_hemisphere(u);
  case Warp::cosine_hemisphere: return sample_cosine_hemisphere(u);
  case Warp::cone: return sample_uniform_cone(u, one_minus_cos_max_);
  case Warp::triangle: {
    const vec3 b = sample_uniform_triangle(u);
    return b.x * kA + b.y * kB + b.z * kC;
  }
  case Warp::spherical_rectangle: return rectangle_.sample(u);
  case Warp::gaussian: return {kGaussian.sample(u.x), kGaussian.sample(u.y), 0};
  }
  return vec3(0);
}

double WarpMap::pdf(vec3 p) const {
  switch (options_.warp) {
  case Warp::disc: return static_cast<double>(kUniformDiscPdf);
  case Warp::sphere: return static_cast<double>(kUniformSpherePdf);
  case Warp::hemisphere: return static_cast<double>(kUniformHemispherePdf);
  case Warp::cosine_hemisphere: return static_cast<double>(cosine_hemisphere_pdf(p.z));
  case Warp::cone: return static_cast<double>(uniform_cone_pdf(one_minus_cos_max_));
  case Warp::triangle: return 1 / kTriangleArea;
  case Warp::spherical_rectangle: {
    // 1 / solid_angle per sr, and cos(theta) / distance^2 sr per unit area.
    const auto distance2 = static_cast<double>(length_squared(p));
    return static_cast<double>(p.z) / (distance2 * std::sqrt(distance2)) /
           static_cast<double>(rectangle_.solid_angle);
  }
  case Warp::gaussian:
    return static_cast<double>(kGaussian.pdf(p.x)) * static_cast<double>(kGaussian.pdf(p.y));
  }
  return 0;
}

vec2 WarpMap::chart(vec3 p) const {
  switch (options_.warp) {
  case Warp::disc: return {turns(p.x, p.y), std::sqrt(sqr(p.x) + sqr(p.y))};
  case Warp::triangle: {
    // p = A + x (B - A) + y (C - A), and the chart's x is the share of the way at that height.
    const float c = p.y / kC.y, b = p.x - c * kC.x;
    return {c < 1 ? b / (1 - c) : 0, c};
  }
  case Warp::spherical_rectangle: return {(p.x - kCorner.x) / kEdgeX.x, (p.y - kCorner.y) / kEdgeY.y};
  case Warp::gaussian: return 0.5f + vec2(p.x, p.y) * (0.5f / kGaussianRadius);
  default: {
    const float one_minus_z = p.z > 0 ? (sqr(p.x) + sqr(p.y)) / (1 + p.z) : 1 - p.z; // no cancellation
    return {turns(p.x, p.y), one_minus_z / one_minus_cos_max_};
  }
  }
}

vec3 WarpMap::from_chart(vec2 q) const {
  const float phi = 2 * kPi * q.x;
  switch (options_.warp) {
  case Warp::disc: return {q.y * std::cos(phi), q.y * std::sin(phi), 0};
  case Warp::triangle: return kA + q.x * (1 - q.y) * (kB - kA) + q.y * (kC - kA);
  case Warp::spherical_rectangle: return kCorner + q.x * kEdgeX + q.y * kEdgeY;
  case Warp::gaussian: return {(2.0f * q - 1.0f) * kGaussianRadius, 0};
  default: {
    const float z = 1 - q.y * one_minus_cos_max_, r = safe_sqrt((1 - z) * (1 + z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  }
}

double WarpMap::chart_measure(vec2 q) const {
  constexpr double kTurn = 2 * std::numbers::pi;
  switch (options_.warp) {
  case Warp::disc: return kTurn * static_cast<double>(q.y);
  case Warp::triangle: return 2 * kTriangleArea * (1 - static_cast<double>(q.y));
  case Warp::spherical_rectangle: return static_cast<double>(kEdgeX.x) * static_cast<double>(kEdgeY.y);
  case Warp::gaussian: return 4 * static_cast<double>(sqr(kGaussianRadius));
  default: return kTurn * static_cast<double>(one_minus_cos_max_);
  }
}

WarpLesson::WarpLesson(const WarpOptions& options, SampleSource source, std::uint64_t samples)
    : options_(options), warp_(options), source_(source), samples_(samples) {
  histogram_.grid = {options.grid, options.grid};
  histogram_.counts.assign(histogram_.grid.size(), 0);
  histogram_.expected = expected_shares(
      histogram_.grid, [&](vec2 q) { return warp_.pdf(warp_.from_chart(q)) * warp_.chart_measure(q); });
}

vec3 WarpLesson::replay(std::uint64_t sample) const {
  Sampler sampler = source_.sampler();
  sampler.start({0, 0}, static_cast<std::uint32_t>(sample));
  return warp_.map(sampler.get_2d(Dimension::film));
}

void WarpLesson::advance(std::uint64_t count) {
  // Coordinates have a few rounding errors: only points beyond those are outside.
  constexpr float kRounding = 1e-5f;
  const std::uint64_t end = done_ + std::min(count, samples_ - done_);
  Sampler sampler = source_.sampler();
  for (; done_ < end; ++done_) {
    sampler.start({0, 0}, static_cast<std::uint32_t>(done_));
    const vec2 q = warp_.chart(warp_.map(sampler.get_2d(Dimension::film)));
    const bool inside =
        q.x >= -kRounding && q.y >= -kRounding && q.x <= 1 + kRounding && q.y <= 1 + kRounding;
    if (inside)
      ++histogram_.counts[histogram_.grid.cell(q)];
    else
      ++histogram_.outside;
  }
  histogram_.total = static_cast<double>(done_);
}

} // namespace candela
