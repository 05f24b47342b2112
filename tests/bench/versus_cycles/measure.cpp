#include "versus_cycles/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace candela::versus {

namespace {

struct Sum {
  double value = 0, variance = 0; ///< of the sum over a region of the mean image
};

/// Pixels are independent; the variance is estimated from pairs of renders: E (a - b)^2 = 2 Var, so that the
/// mean of n has sum over pairs of (a - b)^2 / n^2.
Sum sum_of(const std::vector<Image>& images, int c, int x0, int x1, int y0, int y1) {
  Sum s;
  auto n = static_cast<double>(images.size());
  for (std::size_t i = 0; i < images.size(); i += 2)
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        auto a = static_cast<double>(images[i].at(x, y)[c]),
             b = static_cast<double>(images[i + 1].at(x, y)[c]);
        s.value += (a + b) / n;
        s.variance += (a - b) * (a - b) / (n * n);
      }
  return s;
}

} // namespace

Image mean_of(const std::vector<Image>& images) {
  Image mean = images.front();
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    glm::dvec3 sum(0);
    for (const Image& image : images) sum += glm::dvec3(image.pixels[i]);
    mean.pixels[i] = vec3(sum / static_cast<double>(images.size()));
  }
  return mean;
}

double noise_relative_mse(const std::vector<Image>& images, const Image& reference) {
  double sum = 0;
  for (std::size_t pair = 0; pair < images.size(); pair += 2)
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
      glm::dvec3 d = glm::dvec3(images[pair].pixels[i]) - glm::dvec3(images[pair + 1].pixels[i]),
                 r(reference.pixels[i]), e = 0.5 * d * d / (r * r + 0.01);
      sum += e.x + e.y + e.z;
    }
  return sum / (3 * static_cast<double>(reference.pixels.size()) * static_cast<double>(images.size() / 2));
}

MeansReport compare_means(const std::vector<Image>& a, const std::vector<Image>& b, double image_tolerance,
                          double block_tolerance) {
  constexpr double kSigmas = 6;
  constexpr int kBlocks = 8; // a side
  MeansReport report;
  int width = a.front().width, height = a.front().height;
  auto compare = [&](const std::string& where, std::size_t channel, int x0, int x1, int y0, int y1,
                     double tolerance) -> MeanRatio {
    int c = static_cast<int>(channel);
    Sum sa = sum_of(a, c, x0, x1, y0, y1), sb = sum_of(b, c, x0, x1, y0, y1);
    if (sa.value == 0 && sb.value == 0) return {};
    MeanRatio ratio{sa.value / sb.value, std::sqrt(sa.variance + sb.variance) / sb.value};
    if (!(std::abs(ratio.value - 1) <= kSigmas * ratio.standard_error + tolerance))
      report.disagreements.push_back(fmt::format("{}, {}: {:.4f} +- {:.4f}", where,
                                                 std::array{"red", "green", "blue"}[channel], ratio.value,
                                                 ratio.standard_error));
    return ratio;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    report.image[c] = compare("image", c, 0, width, 0, height, image_tolerance);
    for (int j = 0; j < kBlocks; ++j)
      for (int i = 0; i < kBlocks; ++i) {
        MeanRatio block =
            compare(fmt::format("block ({}, {})", i, j), c, i * width / kBlocks, (i + 1) * width / kBlocks,
                    j * height / kBlocks, (j + 1) * height / kBlocks, block_tolerance);
        if (std::abs(block.value - 1) > std::abs(report.worst_block.value - 1)) report.worst_block = block;
      }
  }
  return report;
}

} // namespace candela::versus
