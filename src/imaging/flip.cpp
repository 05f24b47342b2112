#include "imaging/flip.h"

#include <array>
#include <cassert>
#include <span>

namespace candela {

namespace {

// The paper's parameters.
constexpr float kColorExponent = 0.7f;   // q_c
constexpr float kFeatureExponent = 0.5f; // q_f
constexpr float kColorSplit = 0.4f;      // p_c
constexpr float kErrorSplit = 0.95f;     // p_t
constexpr float kFeatureWidth = 0.082f;  // w, degrees: the peak of the contrast sensitivity's band

using Plane = std::vector<float>;

struct Size {
  int width = 0;
  int height = 0;
  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Weights at -radius ... radius.
struct Kernel {
  std::vector<float> weight;
  int radius() const { return static_cast<int>(weight.size() / 2); }
};

template <class Function>
Kernel make_kernel(int radius, Function f) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.weight.push_back(static_cast<float>(f(i)));
  return kernel;
}

/// Scales positive weights to a sum of 1 and negative ones to -1.
void normalize_signed(Kernel& kernel) {
  float positive = 0, negative = 0;
  for (float w : kernel.weight) (w > 0 ? positive : negative) += w;
  for (float& w : kernel.weight)
    if (w != 0) w /= w > 0 ? positive : -negative;
}

Plane filter_rows(const Plane& in, Size size, const Kernel& kernel) {
  Plane out(in.size());
  int radius = kernel.radius();
  std::vector<float> row(static_cast<std::size_t>(size.width + 2 * radius)); // with its border
  for (int y = 0; y < size.height; ++y) {
    const float* source = in.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width);
    float* target = out.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width);
    for (int x = -radius; x < size.width + radius; ++x)
      row[static_cast<std::size_t>(x + radius)] = source[std::clamp(x, 0, size.width - 1)];
    for (std::size_t k = 0; k < kernel.weight.size(); ++k) {
      float weight = kernel.weight[k];
      const float* shifted = row.data() + k;
      for (int x = 0; x < size.width; ++x) target[x] += weight * shifted[x];
    }
  }
  return out;
}

Plane filter_columns(const Plane& in, Size size, const Kernel& kernel) {
  Plane out(in.size());
  int radius = kernel.radius();
  for (int y = 0; y < size.height; ++y) {
    float* target = out.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width);
    for (int k = -radius; k <= radius; ++k) {
      float weight = kernel.weight[static_cast<std::size_t>(k + radius)];
      int row = std::clamp(y + k, 0, size.height - 1);
      const float* source = in.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width);
      for (int x = 0; x < size.width; ++x) target[x] += weight * source[x];
    }
  }
  return out;
}

Plane filter(const Plane& in, Size size, const Kernel& along_rows, const Kernel& along_columns) {
  return filter_columns(filter_rows(in, size, along_rows), size, along_columns);
}

// Colour spaces -----------------------------------------------------------------------------------------

/// IEC 61966-2-1's primaries under D65; columns are the primaries.
const mat3 kXyzFromRgb(0.4124564f, 0.2126729f, 0.0193339f, 0.3575761f, 0.7151522f, 0.1191920f, 0.1804375f,
                       0.0721750f, 0.9503041f);
const mat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const vec3 kWhite = kXyzFromRgb * vec3(1);

/// The linear opponent space YyCxCz, in which the contrast sensitivities are known.
vec3 opponent_from_rgb(vec3 rgb) {
  vec3 t = kXyzFromRgb * rgb / kWhite;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

vec3 rgb_from_opponent(vec3 c) {
  float y = (c.x + 16) / 116;
  return kRgbFromXyz * (vec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

vec3 lab_from_rgb(vec3 rgb) {
  vec3 t = kXyzFromRgb * rgb / kWhite;
  constexpr float delta = 6.0f / 29.0f;
  for (int c = 0; c < 3; ++c)
    t[c] = t[c] > delta * delta * delta ? std::cbrt(t[c]) : t[c] / (3 * delta * delta) + 4.0f / 29.0f;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

/// Reduces the chroma of dark colours (the Hunt effect).
vec3 hunt_adjusted(vec3 lab) { return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z}; }

/// The HyAB metric: city-block distance in lightness, Euclidean in chroma.
float hyab(vec3 a, vec3 b) {
  vec3 d = a - b;
  return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

float color_error(vec3 a, vec3 b) { return std::pow(hyab(a, b), kColorExponent); }

/// Maps the largest error, between green and blue, to 1; small errors get most of the range.
float redistribute(float error, float largest) {
  float split = kColorSplit * largest;
  if (error < split) return error * (kErrorSplit / split);
  return kErrorSplit + (error - split) / (largest - split) * (1 - kErrorSplit);
}

// The picture, once per input ---------------------------------------------------------------------------

/// exp(-pi^2 x^2 / b) of x in degrees, not normalised.
Kernel sensitivity_kernel(float b, int radius, float pixels_per_degree) {
  return make_kernel(radius, [&](int i) {
    float x = static_cast<float>(i) / pixels_per_degree;
    return std::exp(-kPi * kPi * x * x / b);
  });
}

float square_sum(const Kernel& kernel) { // of the two-dimensional kernel
  float sum = 0;
  for (float w : kernel.weight) sum += w;
  return sum * sum;
}

/// A sum of a_i sqrt(pi / b_i) exp(-pi^2 r^2 / b_i), each term separable, to unit sum.
struct Term {
  float a = 0;
  float b = 1;
};
Plane filter_sensitivity(const Plane& in, Size size, std::span<const Term> terms, int radius, float ppd) {
  Plane out(in.size());
  float total = 0;
  for (Term term : terms) {
    Kernel kernel = sensitivity_kernel(term.b, radius, ppd);
    float amplitude = term.a * std::sqrt(kPi / term.b);
    total += amplitude * square_sum(kernel);
    Plane part = filter(in, size, kernel, kernel);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += amplitude * part[i];
  }
  for (float& v : out) v /= total;
  return out;
}

struct Appearance {
  std::vector<vec3> color; ///< Hunt-adjusted Lab of the picture, filtered by the contrast sensitivity
  Plane edge, point;       ///< strength of the features
};

Appearance appearance(const Image& image, float ppd) {
  Size size{image.width, image.height};
  std::array<Plane, 3> opponent;
  for (auto& plane : opponent) plane.resize(size.count());
  for (std::size_t i = 0; i < size.count(); ++i) {
    vec3 rgb = image.pixels[i];
    for (int c = 0; c < 3; ++c) rgb[c] = rgb[c] > 0 ? std::min(rgb[c], 1.0f) : 0; // NaN too
    vec3 o = opponent_from_rgb(rgb);
    for (int c = 0; c < 3; ++c) opponent[static_cast<std::size_t>(c)][i] = o[c];
  }

  constexpr float kWidestB = 0.04f;
  constexpr Term kAchromatic[] = {{1, 0.0047f}};
  constexpr Term kRedGreen[] = {{1, 0.0053f}};
  constexpr Term kBlueYellow[] = {{34.1f, kWidestB}, {13.5f, 0.025f}};
  int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidestB / (2 * kPi * kPi)) * ppd));
  Plane y = filter_sensitivity(opponent[0], size, kAchromatic, radius, ppd);
  Plane cx = filter_sensitivity(opponent[1], size, kRedGreen, radius, ppd);
  Plane cz = filter_sensitivity(opponent[2], size, kBlueYellow, radius, ppd);
  Appearance out;
  out.color.resize(size.count());
  for (std::size_t i = 0; i < size.count(); ++i)
    out.color[i] =
        hunt_adjusted(lab_from_rgb(glm::clamp(rgb_from_opponent({y[i], cx[i], cz[i]}), vec3(0), vec3(1))));

  // Features are detected in the unfiltered lightness, from 0 to 1.
  Plane grey = std::move(opponent[0]);
  for (float& v : grey) v = (v + 16) / 116;
  float sigma = 0.5f * kFeatureWidth * ppd;
  int feature_radius = static_cast<int>(std::ceil(3 * sigma));
  auto gauss = [&](int i) { return std::exp(-sqr(static_cast<float>(i) / sigma) / 2); };
  Kernel smooth = make_kernel(feature_radius, gauss);
  Kernel first = make_kernel(feature_radius, [&](int i) { return -static_cast<float>(i) * gauss(i); });
  Kernel second =
      make_kernel(feature_radius, [&](int i) { return (sqr(static_cast<float>(i) / sigma) - 1) * gauss(i); });
  for (Kernel* kernel : {&smooth, &first, &second}) normalize_signed(*kernel);
  auto strength = [&](const Kernel& derivative) {
    Plane dx = filter(grey, size, derivative, smooth), dy = filter(grey, size, smooth, derivative);
    for (std::size_t i = 0; i < dx.size(); ++i) dx[i] = std::sqrt(dx[i] * dx[i] + dy[i] * dy[i]);
    return dx;
  };
  out.edge = strength(first);
  out.point = strength(second);
  return out;
}

} // namespace

std::vector<float> flip_map(const Image& a, const Image& b, float pixels_per_degree) {
  assert(a.width == b.width && a.height == b.height);
  Appearance seen_a = appearance(a, pixels_per_degree), seen_b = appearance(b, pixels_per_degree);
  float largest = color_error(hunt_adjusted(lab_from_rgb({0, 1, 0})), hunt_adjusted(lab_from_rgb({0, 0, 1})));
  std::vector<float> error(a.pixels.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    float color = redistribute(color_error(seen_a.color[i], seen_b.color[i]), largest);
    float difference =
        std::max(std::abs(seen_a.edge[i] - seen_b.edge[i]), std::abs(seen_a.point[i] - seen_b.point[i]));
    float feature = std::pow(difference / std::numbers::sqrt2_v<float>, kFeatureExponent);
    error[i] = std::pow(color, 1 - std::min(feature, 1.0f)); // pow(0, 0) is 1
  }
  return error;
}

} // namespace candela
