#include "imaging/compare.h"

#include "core/color.h"
#include "imaging/color_map.h"
#include "imaging/flip.h"

#include <fmt/format.h>

#include <cassert>

namespace candela {

namespace {

/// The denominator of relMSE.
double unit_of(float r) { return static_cast<double>(r) * static_cast<double>(r) + 0.01; }

double squared_relative_error(float x, float r) {
  double d = static_cast<double>(x) - static_cast<double>(r);
  return d * d / unit_of(r);
}

double encoded(float x) {
  return static_cast<double>(srgb_from_linear(x > 0 ? std::min(x, 1.0f) : 0.0f)); // NaN is 0
}

double ratio(double x, double r) { return x == r ? 1 : x / r; }

} // namespace

double relative_error(vec3 x, vec3 r) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += squared_relative_error(x[c], r[c]);
  return std::sqrt(sum / 3);
}

double relative_mse(std::span<const vec3> image, std::span<const vec3> reference) {
  assert(image.size() == reference.size());
  double sum = 0;
  std::size_t finite = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!is_finite(image[i]) || !is_finite(reference[i])) continue;
    ++finite;
    for (int c = 0; c < 3; ++c) sum += squared_relative_error(image[i][c], reference[i][c]);
  }
  return sum / (3 * static_cast<double>(std::max<std::size_t>(finite, 1)));
}

double relative_variance(vec3 mean, vec3 variance_of_mean) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += static_cast<double>(variance_of_mean[c]) / unit_of(mean[c]);
  return sum / 3;
}

ComparisonResult compare_images(const Image& image, const Image& reference) {
  assert(image.width == reference.width && image.height == reference.height);
  ComparisonResult result;
  result.width = image.width;
  result.height = image.height;
  double encoded_squares = 0;
  std::array<double, 3> sum_x{}, sum_r{};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    vec3 x = image.pixels[i], r = reference.pixels[i];
    for (int c = 0; c < 3; ++c) {
      double d = encoded(x[c]) - encoded(r[c]);
      encoded_squares += d * d;
    }
    if (!is_finite(x) || !is_finite(r)) {
      ++result.nonfinite;
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      double d = static_cast<double>(x[c]) - static_cast<double>(r[c]);
      result.mse += d * d;
      sum_x[static_cast<std::size_t>(c)] += static_cast<double>(x[c]);
      sum_r[static_cast<std::size_t>(c)] += static_cast<double>(r[c]);
    }
    result.largest_relative_error = std::max(result.largest_relative_error, relative_error(x, r));
  }
  double values = 3 * static_cast<double>(image.pixels.size());
  double finite = std::max(values - 3 * static_cast<double>(result.nonfinite), 1.0);
  result.mse /= finite;
  result.rel_mse = relative_mse(image.pixels, reference.pixels);
  result.psnr = -10 * std::log10(encoded_squares / values);
  for (std::size_t c = 0; c < 3; ++c) result.mean_ratio[c] = ratio(sum_x[c], sum_r[c]);
  double sum = 0;
  for (float error : flip_map(image, reference)) sum += static_cast<double>(error);
  result.flip = sum / static_cast<double>(image.pixels.size());
  return result;
}

std::string comparison_json(const ComparisonResult& result) {
  auto number = [](double v) { return std::isfinite(v) ? fmt::format("{}", v) : std::string("null"); };
  return fmt::format(R"({{
  "width": {},
  "height": {},
  "relMSE": {},
  "MSE": {},
  "PSNR": {},
  "FLIP": {},
  "mean_ratio": [{}, {}, {}],
  "largest_relative_error": {},
  "nonfinite_pixels": {}
}})",
                     result.width, result.height, number(result.rel_mse), number(result.mse),
                     number(result.psnr), number(result.flip), number(result.mean_ratio[0]),
                     number(result.mean_ratio[1]), number(result.mean_ratio[2]),
                     number(result.largest_relative_error), result.nonfinite);
}

std::vector<std::uint8_t> relative_error_picture(const Image& image, const Image& reference) {
  assert(image.width == reference.width && image.height == reference.height);
  constexpr std::array<std::uint8_t, 3> kNonFinite = {0, 255, 255};
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    vec3 x = image.pixels[i], r = reference.pixels[i];
    bool finite = is_finite(x) && is_finite(r);
    auto decades = static_cast<float>(std::log10(std::max(relative_error(x, r), 1e-3)));
    for (std::uint8_t value : finite ? map_color(ColorMap::magma, (decades + 3) / 3) : kNonFinite)
      rgb.push_back(value);
  }
  return rgb;
}

} // namespace candela
