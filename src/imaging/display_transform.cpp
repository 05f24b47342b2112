#include "imaging/display_transform.h"

#include "core/color.h"
#include "imaging/exposure.h"

#include <array>
#include <cassert>
#include <vector>

namespace candela {

namespace {

/// Enough for a percentile of one percent, few enough to sort for every picture.
constexpr std::size_t kMaxSorted = std::size_t{1} << 16;
constexpr float kMaxDecades = 6;

bool is_logarithmic(View view) { return view == View::radiance || view == View::variance; }

/// The scalar of a pixel; the channels of a scalar view are equal.
float value_of(vec3 linear) {
  return linear.x == linear.y && linear.y == linear.z ? linear.x : luminance(linear);
}

struct Range {
  float lo, hi;
};

/// Of the finite and, if requested, positive values: percentiles over a regular subset, and the maximum of
/// all.
struct Percentiles {
  float low = 0, high = 0, largest = 0;
};

Percentiles percentiles_of(std::span<const vec3> linear, bool only_positive) {
  const std::size_t stride = (linear.size() + kMaxSorted - 1) / kMaxSorted;
  std::vector<float> values;
  values.reserve(kMaxSorted);
  Percentiles spread;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const float v = value_of(linear[i]);
    if (!std::isfinite(v) || (only_positive && v <= 0)) continue;
    spread.largest = std::max(spread.largest, v);
    if (i % stride == 0) values.push_back(v);
  }
  if (values.empty()) return spread;
  auto percentile = [&](double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  spread.low = percentile(0.01);
  spread.high = percentile(0.99);
  return spread;
}

Range automatic_range(std::span<const vec3> linear, View view, bool logarithmic) {
  if (view == View::light_share) return {0, 1};
  const Percentiles spread = percentiles_of(linear, logarithmic || view == View::depth);
  if (logarithmic) return {std::max(spread.low, spread.high * std::pow(10.0f, -kMaxDecades)), spread.high};
  if (view == View::depth) return {spread.low, spread.high};
  if (view == View::samples || view == View::nonfinite) return {0, spread.largest};
  return {0, spread.high};
}

FalseColorScale scale_of(std::span<const vec3> linear, const DisplaySettings& display, View view) {
  FalseColorScale scale;
  scale.map = display.false_color == FalseColor::magma ? ColorMap::magma : ColorMap::viridis;
  scale.black_at_zero = view == View::depth;
  scale.logarithmic = is_logarithmic(view);
  Range range{display.false_color_min, display.false_color_max};
  if (range.hi <= range.lo) range = automatic_range(linear, view, scale.logarithmic);
  if (!(range.hi > range.lo)) range.hi = range.lo > 0 ? 2 * range.lo : range.lo + 1; // all pixels are equal
  if (range.lo <= 0) scale.logarithmic = false;                                      // requested by the user
  scale.lo = range.lo;
  scale.hi = range.hi;
  return scale;
}

bool shows_false_color(const DisplaySettings& display, View view) {
  if (display.false_color == FalseColor::automatic) return is_scalar_view(view);
  return display.false_color != FalseColor::off;
}

/// The colours of a scale in steps too small to be visible.
class ColorTable {
public:
  explicit ColorTable(const FalseColorScale& scale) : scale_(scale) {
    for (std::size_t i = 0; i < kSize; ++i)
      colors_[i] = map_color(scale.map, static_cast<float>(i) / static_cast<float>(kSize - 1));
  }
  std::array<std::uint8_t, 3> operator()(vec3 linear) const {
    const float value = value_of(linear);
    if (scale_.black_at_zero && value == 0) return {0, 0, 0};
    const float t = scale_.position(value);
    const float clipped = t > 0 ? std::min(t, 1.0f) : 0; // NaN too
    return colors_[static_cast<std::size_t>(clipped * static_cast<float>(kSize - 1) + 0.5f)];
  }

private:
  static constexpr std::size_t kSize = 2048;
  FalseColorScale scale_;
  std::array<std::array<std::uint8_t, 3>, kSize> colors_;
};

} // namespace

float FalseColorScale::position(float v) const {
  if (logarithmic) return v > 0 ? std::log2(v / lo) / std::log2(hi / lo) : (v <= 0 ? -kInfinity : v);
  return (v - lo) / (hi - lo);
}

float FalseColorScale::value(float t) const {
  return logarithmic ? lo * std::exp2(t * std::log2(hi / lo)) : lo + t * (hi - lo);
}

DisplayTransform display_transform(std::span<const vec3> linear, int width, int height,
                                   const DisplaySettings& display, View view, float display_scale) {
  DisplayTransform transform;
  transform.tone = display;
  transform.tone.auto_exposure = false;
  transform.tone.dither = display.dither && view == View::radiance;
  if (shows_false_color(display, view)) {
    transform.false_color = scale_of(linear, display, view);
  } else if (display.auto_exposure && view == View::radiance) {
    transform.automatic_exposure = automatic_exposure(linear, width, height);
    transform.tone.exposure += transform.automatic_exposure;
  } else if (view != View::radiance) {
    // Properties are not exposed: an exposure for the scene's radiance does not suit an albedo.
    transform.tone.tone_map = ToneMap::srgb;
    transform.tone.exposure = std::log2(display_scale);
  }
  return transform;
}

void display_rgb8(std::span<const vec3> linear, PictureRows rows, const DisplayTransform& transform,
                  std::span<std::uint8_t> rgb) {
  if (!transform.false_color) return tone_map_rgb8(linear, rows, transform.tone, rgb);
  assert(rgb.size() >= 3 * linear.size());
  const ColorTable table(*transform.false_color);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const auto color = table(linear[i]);
    std::copy(color.begin(), color.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
}

void display_rgba8(std::span<const vec3> linear, PictureRows rows, const DisplayTransform& transform,
                   std::span<std::uint8_t> rgba) {
  if (!transform.false_color) return tone_map_rgba8(linear, rows, transform.tone, rgba);
  assert(rgba.size() >= 4 * linear.size());
  const ColorTable table(*transform.false_color);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const auto color = table(linear[i]);
    std::copy(color.begin(), color.end(), rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
    rgba[4 * i + 3] = 255;
  }
}

std::string_view view_unit(View view) {
  switch (view) {
  case View::radiance: return "W/(m^2 sr)";
  case View::variance: return "(W/(m^2 sr))^2";
  case View::depth: return "scene units";
  case View::optical_depth: return "optical depth";
  case View::bvh_cost: return "nodes and primitives";
  case View::samples:
  case View::nonfinite: return "samples";
  default: return "";
  }
}

} // namespace candela
