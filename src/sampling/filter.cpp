#include "sampling/filter.h"

#include "sampling/spherical_rectangle.h"

namespace candela {

namespace {

constexpr double kBlackmanHarris[] = {0.35875, 0.48829, 0.14128, 0.01168};

bool tabulated(FilterType type) {
  return type == FilterType::blackman_harris || type == FilterType::mitchell;
}

} // namespace

double filter_value(FilterType type, double x) {
  x = std::abs(x);
  if (x > 1) return 0;
  switch (type) {
  case FilterType::box: return 1;
  case FilterType::tent: return 1 - x;
  case FilterType::gaussian: return std::exp(-4.5 * x * x);
  case FilterType::blackman_harris: {
    // The window counts from its edge: cosines of 2 pi k (1 + x) / 2, by Chebyshev's polynomials of the
    // first.
    double c = -detail::cos_sin(std::numbers::pi * x).cos;
    return kBlackmanHarris[0] - kBlackmanHarris[1] * c + kBlackmanHarris[2] * (2 * c * c - 1) -
           kBlackmanHarris[3] * c * (4 * c * c - 3);
  }
  case FilterType::mitchell: {
    double t = 2 * x;
    if (t < 1) return (7 * t * t * t - 12 * t * t + 16.0 / 3) / 6;
    return (2 - t) * (2 - t) * (8 - 7 * t) / 18;
  }
  }
  return 0;
}

double filter_integral(FilterType type) {
  switch (type) {
  case FilterType::box: return 2;
  case FilterType::tent: return 1;
  case FilterType::gaussian: return std::sqrt(2 * std::numbers::pi) / 3 * std::erf(3 / std::numbers::sqrt2);
  case FilterType::blackman_harris: return 2 * kBlackmanHarris[0]; // whole periods of the cosines
  case FilterType::mitchell: return 0.5;                           // 1 over t
  }
  return 0;
}

PixelFilter::PixelFilter(FilterType type, float radius)
    : type_(type), radius_(radius), gaussian_(1.0f / 3, 1) {
  if (!tabulated(type)) return;
  std::array<double, kCells + 1> value, sum{};
  constexpr double kWidth = 2.0 / kCells;
  for (std::size_t i = 0; i <= kCells; ++i) {
    value[i] = std::abs(filter_value(type, static_cast<double>(i) * kWidth - 1));
    if (i > 0) sum[i] = sum[i - 1] + 0.5 * kWidth * (value[i - 1] + value[i]);
  }
  for (std::size_t i = 0; i <= kCells; ++i) {
    density_[i] = static_cast<float>(value[i] / sum[kCells]);
    cdf_[i] = static_cast<float>(sum[i] / sum[kCells]);
  }
}

PixelFilter::AxisSample PixelFilter::sample_axis(float u) const {
  switch (type_) {
  case FilterType::box: return {2 * u - 1, 1};
  case FilterType::tent: return {u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u), 1};
  case FilterType::gaussian: return {gaussian_.sample(u), 1};
  default: break;
  }
  auto above = std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, u);
  auto cell = static_cast<std::size_t>(above - cdf_.begin()) - 1;
  // Where the integral of d0 + (d1 - d0) t is v times that over the cell.
  float d0 = density_[cell], d1 = density_[cell + 1];
  float v = (u - cdf_[cell]) / (cdf_[cell + 1] - cdf_[cell]);
  float root = std::sqrt(d0 * d0 + v * (d1 * d1 - d0 * d0)); // the density there
  if (!(root > 0)) return {-1, 0};                           // u = 0 where the filter starts at 0
  float t = std::min(v * (d0 + d1) / (d0 + root), 1.0f);
  float x = (static_cast<float>(cell) + t) * (2.0f / kCells) - 1;
  double weight =
      filter_value(type_, static_cast<double>(x)) / (static_cast<double>(root) * filter_integral(type_));
  return {x, static_cast<float>(weight)};
}

FilterSample PixelFilter::sample(vec2 u) const {
  AxisSample x = sample_axis(u.x), y = sample_axis(u.y);
  return {vec2(x.x, y.x) * radius_, x.weight * y.weight};
}

} // namespace candela
