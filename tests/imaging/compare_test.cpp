#include "core/color.h"
#include "imaging/color_map.h"
#include "imaging/compare.h"
#include "imaging/flip.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

Image uniform(int width, int height, vec3 color) {
  return {width, height, std::vector<vec3>(static_cast<std::size_t>(width * height), color)};
}

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Image image = uniform(width, height, vec3(0));
  for (vec3& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = value(random);
  return image;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

TEST(Compare, EqualPicturesDifferByNothing) {
  Image image = noise(20, 10, 1);
  ComparisonResult result = compare_images(image, image);
  EXPECT_EQ(result.width, 20);
  EXPECT_EQ(result.height, 10);
  EXPECT_EQ(result.rel_mse, 0);
  EXPECT_EQ(result.mse, 0);
  EXPECT_EQ(result.flip, 0);
  EXPECT_EQ(result.psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.largest_relative_error, 0);
  for (double ratio : result.mean_ratio) EXPECT_EQ(ratio, 1);
}

TEST(Compare, UniformPicturesHaveClosedForms) {
  vec3 x(0.6f, 0.25f, 0), r(0.5f, 0.25f, 0.1f);
  ComparisonResult result = compare_images(uniform(7, 5, x), uniform(7, 5, r));
  EXPECT_NEAR(result.mse, (0.01 + 0 + 0.01) / 3, 1e-8);
  EXPECT_NEAR(result.rel_mse, (0.01 / 0.26 + 0 + 0.01 / 0.02) / 3, 1e-7);
  EXPECT_NEAR(result.mean_ratio[0], 1.2, 1e-6);
  EXPECT_EQ(result.mean_ratio[1], 1);
  EXPECT_EQ(result.mean_ratio[2], 0);
  EXPECT_NEAR(result.largest_relative_error, std::sqrt(result.rel_mse), 1e-12);
  // sRGB of 0.6, 0.5, 0.1: 0.797738, 0.735357, 0.349190.
  double squares = (0.797738 - 0.735357) * (0.797738 - 0.735357) + 0.349190 * 0.349190;
  EXPECT_NEAR(result.psnr, -10 * std::log10(squares / 3), 1e-4);
}

TEST(Compare, OnePixelOfManyCountsItsShare) {
  Image reference = uniform(10, 10, vec3(0.3f)), image = reference;
  image.at(3, 4) = vec3(0.3f, 1.3f, 0.3f);
  ComparisonResult result = compare_images(image, reference);
  EXPECT_NEAR(result.mse, 1.0 / 300, 1e-9);
  EXPECT_NEAR(result.rel_mse, 1 / (0.09 + 0.01) / 300, 1e-7);
  EXPECT_NEAR(result.mean_ratio[1], 31.0 / 30, 1e-6);
}

TEST(Compare, RelativeMseIsRelativeToTheReference) {
  Image a = uniform(2, 2, vec3(1)), b = uniform(2, 2, vec3(2));
  EXPECT_NEAR(compare_images(a, b).rel_mse, 1 / 4.01, 1e-9);
  EXPECT_NEAR(compare_images(b, a).rel_mse, 1 / 1.01, 1e-9);
}

TEST(Compare, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
  Image reference = uniform(4, 1, vec3(0.5f)), image = reference;
  image.at(0, 0).y = std::nanf("");
  reference.at(1, 0).z = kInfinity;
  image.at(2, 0) = vec3(0.7f);
  ComparisonResult result = compare_images(image, reference);
  EXPECT_EQ(result.nonfinite, 2);
  EXPECT_NEAR(result.mse, 0.04 / 2, 1e-8);
  EXPECT_TRUE(std::isfinite(result.flip));
  EXPECT_TRUE(std::isfinite(result.psnr));
}

TEST(Compare, JsonHasNoInfinity) {
  Image image = uniform(2, 1, vec3(0));
  std::string json = comparison_json(compare_images(image, image));
  EXPECT_NE(json.find("\"PSNR\": null"), std::string::npos) << json;
  EXPECT_NE(json.find("\"relMSE\": 0"), std::string::npos) << json;
  EXPECT_EQ(json.find("inf"), std::string::npos) << json;
}

TEST(Compare, TheErrorPictureRisesByDecades) {
  Image reference = uniform(5, 1, vec3(0)), image = reference; // the error is then ten times the value
  float values[] = {0, 0.0001f, 0.001f, 0.1f, 5};
  for (int i = 0; i < 5; ++i) image.at(i, 0) = vec3(values[i]);
  auto rgb = relative_error_picture(image, reference);
  auto pixel = [&](std::size_t i) { return std::array{rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]}; };
  EXPECT_EQ(pixel(0), map_color(ColorMap::magma, 0));
  EXPECT_EQ(pixel(1), map_color(ColorMap::magma, 0));
  EXPECT_EQ(pixel(2), map_color(ColorMap::magma, 1.0f / 3));
  EXPECT_EQ(pixel(3), map_color(ColorMap::magma, 1));
  EXPECT_EQ(pixel(4), map_color(ColorMap::magma, 1));
  image.at(2, 0).x = kInfinity;
  rgb = relative_error_picture(image, reference);
  EXPECT_EQ(pixel(2), (std::array<std::uint8_t, 3>{0, 255, 255}));
}

TEST(ColorMap, LightnessRises) {
  for (ColorMap map : {ColorMap::magma, ColorMap::viridis}) {
    float last = -1;
    for (int i = 0; i <= 64; ++i) {
      auto rgb = map_color(map, static_cast<float>(i) / 64);
      vec3 linear;
      for (int c = 0; c < 3; ++c)
        linear[c] = linear_from_srgb(static_cast<float>(rgb[static_cast<std::size_t>(c)]) / 255);
      EXPECT_GT(luminance(linear), last) << i;
      last = luminance(linear);
    }
    EXPECT_EQ(map_color(map, -1), map_color(map, 0));
    EXPECT_EQ(map_color(map, 2), map_color(map, 1));
    EXPECT_EQ(map_color(map, std::nanf("")), map_color(map, 0));
  }
}

// FLIP --------------------------------------------------------------------------------------------------

TEST(Flip, UniformColoursHaveTheirHandComputedErrors) {
  // Without edges or detail only the colours' part is left: HyAB of the Hunt-adjusted Lab to the power of
  // 0.7, over 41.27 (green and blue), with 0.4 of the range stretched to 0.95. Worked out from those formulas
  // alone.
  struct Case {
    vec3 a, b;
    float error;
  };
  Case cases[] = {
      {vec3(0), vec3(1), 0.967381f},
      {vec3(0, 1, 0), vec3(0, 0, 1), 1.0f},
      {vec3(0.18f), vec3(0.2f), 0.104368f},
      {vec3(1, 0, 0), vec3(0), 0.970501f},
      {vec3(0.5f, 0.25f, 0.1f), vec3(0.1f, 0.3f, 0.6f), 0.801023f},
      {vec3(0.5f), vec3(0), 0.958543f},
  };
  for (const Case& c : cases)
    for (float error : flip_map(uniform(30, 3, c.a), uniform(30, 3, c.b)))
      ASSERT_NEAR(error, c.error, 2e-4f) << c.error;
}

TEST(Flip, ClipsWhatAScreenCannotShow) {
  EXPECT_NEAR(mean(flip_map(uniform(4, 4, vec3(1)), uniform(4, 4, vec3(50)))), 0, 1e-6);
  EXPECT_NEAR(mean(flip_map(uniform(4, 4, vec3(0)), uniform(4, 4, vec3(-3)))), 0, 1e-6);
}

TEST(Flip, IsSymmetricAndFromZeroToOne) {
  Image a = noise(40, 30, 1), b = noise(40, 30, 2);
  auto ab = flip_map(a, b), ba = flip_map(b, a);
  EXPECT_EQ(ab, ba);
  for (float error : ab) {
    EXPECT_GE(error, 0);
    EXPECT_LE(error, 1);
  }
  EXPECT_EQ(mean(flip_map(a, a)), 0);
}

TEST(Flip, GrowsWithTheDifference) {
  double last = 0;
  for (float grey : {0.21f, 0.25f, 0.35f, 0.6f, 1.0f}) {
    double error = mean(flip_map(uniform(16, 16, vec3(0.2f)), uniform(16, 16, vec3(grey))));
    EXPECT_GT(error, last);
    last = error;
  }
}

TEST(Flip, FineDetailIsLessVisibleFromAfar) {
  Image grey = uniform(64, 64, vec3(0.2140f)), checks = grey; // mean 0.5 would differ in lightness
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) checks.at(x, y) = vec3((x + y) % 2 ? 0.3f : 0.128f);
  double near = mean(flip_map(checks, grey, 20)), far = mean(flip_map(checks, grey, 120));
  EXPECT_LT(far, 0.8 * near);
}

/// The paper's definition with two-dimensional kernels and no shared code, for small pictures.
class SlowFlip {
public:
  SlowFlip(int w, int h, double pixels_per_degree) : width(w), height(h), ppd(pixels_per_degree) {}

  std::vector<double> operator()(const Image& a, const Image& b) const {
    double largest = std::pow(hyab(hunt(lab({0, 1, 0})), hunt(lab({0, 0, 1}))), 0.7);
    auto ca = colors(a), cb = colors(b);
    std::vector<double> ea, pa, eb, pb;
    features(a, ea, pa), features(b, eb, pb);
    std::vector<double> out;
    for (std::size_t i = 0; i < ca.size(); ++i) {
      double e = std::pow(hyab(ca[i], cb[i]), 0.7), s = 0.4 * largest;
      double color = e < s ? e / s * 0.95 : 0.95 + (e - s) / (largest - s) * 0.05;
      double f = std::sqrt(std::max(std::abs(ea[i] - eb[i]), std::abs(pa[i] - pb[i])) / std::sqrt(2.0));
      out.push_back(std::pow(color, 1 - f));
    }
    return out;
  }

private:
  using V = glm::dvec3;
  using Grid = std::vector<V>;
  int width, height;
  double ppd;

  static V normalized_xyz(V c) {
    V xyz(0.4124564 * c.x + 0.3575761 * c.y + 0.1804375 * c.z,
          0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z,
          0.0193339 * c.x + 0.1191920 * c.y + 0.9503041 * c.z);
    return xyz / V(0.95047, 1.0000001, 1.08883);
  }
  static V rgb(V t) {
    glm::dmat3 m = glm::transpose(glm::dmat3(0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750,
                                             0.0193339, 0.1191920, 0.9503041));
    return glm::clamp(glm::inverse(m) * (t * V(0.95047, 1.0000001, 1.08883)), V(0), V(1));
  }
  static V lab(V c) {
    V t = normalized_xyz(c), f;
    for (int i = 0; i < 3; ++i)
      f[i] = t[i] > 216.0 / 24389 ? std::cbrt(t[i]) : (24389.0 / 27 * t[i] + 16) / 116;
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
  }
  static V hunt(V l) { return {l.x, l.x * l.y / 100, l.x * l.z / 100}; }
  static double hyab(V a, V b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

  template <class F>
  V convolve(const Grid& in, int x, int y, int radius, F weight) const {
    V sum(0);
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i) {
        auto at = static_cast<std::size_t>(std::clamp(y + j, 0, height - 1) * width +
                                           std::clamp(x + i, 0, width - 1));
        sum += V(weight(i, j)) * in[at];
      }
    return sum;
  }

  Grid colors(const Image& image) const {
    Grid opponent;
    for (vec3 p : image.pixels) {
      V t = normalized_xyz(V(p));
      opponent.push_back({116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)});
    }
    int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
    auto raw = [&](int i, int j) {
      double d2 = (i * i + j * j) / (ppd * ppd), pi = std::numbers::pi;
      auto g = [&](double a, double b) { return a * std::sqrt(pi / b) * std::exp(-pi * pi * d2 / b); };
      return V(g(1, 0.0047), g(1, 0.0053), g(34.1, 0.04) + g(13.5, 0.025));
    };
    V total(0);
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i) total += raw(i, j);
    Grid out;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        V c = convolve(opponent, x, y, radius, [&](int i, int j) { return raw(i, j) / total; });
        double l = (c.x + 16) / 116;
        out.push_back(hunt(lab(rgb({l + c.y / 500, l, l - c.z / 200}))));
      }
    return out;
  }

  void features(const Image& image, std::vector<double>& edge, std::vector<double>& point) const {
    Grid grey;
    for (vec3 p : image.pixels) grey.push_back(V(normalized_xyz(V(p)).y));
    double sigma = 0.5 * 0.082 * ppd;
    int radius = static_cast<int>(std::ceil(3 * sigma));
    auto raw = [&](int i, int j) {
      double g = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
      return V(-i * g, (i * i / (sigma * sigma) - 1) * g, 0);
    };
    V positive(0), negative(0);
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i)
        positive += glm::max(raw(i, j), V(0)), negative -= glm::min(raw(i, j), V(0));
    auto weight = [&](int i, int j) {
      V w = raw(i, j);
      for (int c = 0; c < 2; ++c) w[c] /= w[c] > 0 ? positive[c] : negative[c];
      return w;
    };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        V dx = convolve(grey, x, y, radius, weight);
        V dy = convolve(grey, x, y, radius, [&](int i, int j) { return weight(j, i); });
        edge.push_back(std::hypot(dx.x, dy.x));
        point.push_back(std::hypot(dx.y, dy.y));
      }
  }
};

TEST(Flip, AgreesWithTheDefinitionByPlainConvolution) {
  constexpr int kWidth = 23, kHeight = 17;
  Image a = noise(kWidth, kHeight, 5), b = a;
  for (int y = 4; y < 11; ++y) // an edge, a line, a shift of colour
    for (int x = 6; x < 15; ++x) b.at(x, y) = vec3(0.9f, 0.2f, 0.4f);
  for (int y = 0; y < kHeight; ++y) b.at(18, y) = vec3(0);
  for (float ppd : {20.0f, kFlipPixelsPerDegree}) {
    auto fast = flip_map(a, b, ppd);
    auto slow = SlowFlip(kWidth, kHeight, static_cast<double>(ppd))(a, b);
    for (std::size_t i = 0; i < fast.size(); ++i)
      ASSERT_NEAR(static_cast<double>(fast[i]), slow[i], 2e-3) << i << " at " << ppd;
  }
}

} // namespace
} // namespace candela
