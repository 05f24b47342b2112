#include "render/film/film_view.h"

#include "core/color.h"
#include "imaging/compare.h"
#include "render/world/render_scene.h"

#include <cassert>
#include <limits>

namespace candela {

namespace {

vec3 resolved_pixel(const Film& film, View view, int x, int y) {
  switch (view) {
  case View::depth_share: {
    vec3 m = film.mean(x, y);
    float total = m.x + m.y + m.z;
    return total > 0 ? m / total : vec3(0);
  }
  case View::light_share: {
    vec3 m = film.mean(x, y);
    float total = m.x + m.y;
    return vec3(total > 0 ? m.x / total : 0.0f);
  }
  case View::variance:
    return vec3(luminance(film.variance_of_mean(x, y)) * static_cast<float>(film.count(x, y)));
  case View::samples: return vec3(static_cast<float>(film.count(x, y)));
  case View::nonfinite: return vec3(static_cast<float>(film.nonfinite(x, y)));
  default: return film.mean(x, y);
  }
}

std::size_t pixel_count(const Film& film) {
  return static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height());
}

constexpr int kMeasurable = 2; ///< samples from which a variance is known

/// Of values added in pixel order, so that it is the same for any number of threads.
class MeasuredMean {
public:
  void add(double value) { sum_ += value, ++count_; }
  double value() const {
    return count_ > 0 ? sum_ / static_cast<double>(count_) : std::numeric_limits<double>::infinity();
  }

private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

} // namespace

float display_scale(const RenderScene& scene, const RenderSettings& settings) {
  if (settings.view != View::depth) return 1;
  Bounds3 bounds = scene.geometry().finite_bounds();
  float diagonal = bounds.empty() ? 0 : glm::length(bounds.diagonal());
  return diagonal > 0 ? 1 / diagonal : 1;
}

void resolve_view(const Film& film, View view, int coarseness, std::vector<vec3>& out) {
  out.resize(pixel_count(film));
  const int width = film.width(), height = film.height();
  vec3* pixels = out.data();
#pragma omp parallel for schedule(static)
  for (int y0 = 0; y0 < height; y0 += coarseness) {
    vec3* row = pixels + static_cast<std::ptrdiff_t>(y0) * width;
    for (int x0 = 0; x0 < width; x0 += coarseness)
      std::fill(row + x0, row + std::min(x0 + coarseness, width), resolved_pixel(film, view, x0, y0));
    for (int y = y0 + 1; y < std::min(y0 + coarseness, height); ++y)
      std::copy(row, row + width, pixels + static_cast<std::ptrdiff_t>(y) * width);
  }
}

Image view_image(const Film& film, View view) {
  Image image{film.width(), film.height(), {}};
  resolve_view(film, view, 1, image.pixels);
  return image;
}

void resolve_statistics(const Film& film, std::vector<vec3>& variance_of_mean,
                        std::vector<std::uint32_t>& samples) {
  variance_of_mean.resize(pixel_count(film));
  samples.resize(pixel_count(film));
  const int width = film.width(), height = film.height();
#pragma omp parallel for schedule(static)
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      variance_of_mean[i] = film.variance_of_mean(x, y);
      samples[i] = static_cast<std::uint32_t>(film.count(x, y));
    }
}

double estimated_relmse(const Film& film) {
  MeasuredMean mean;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      if (film.count(x, y) >= kMeasurable) mean.add(film.relative_variance(x, y));
  return mean.value();
}

double estimated_relmse(std::span<const vec3> mean, std::span<const vec3> variance_of_mean,
                        std::span<const std::uint32_t> samples) {
  assert(mean.size() == samples.size() && variance_of_mean.size() == samples.size());
  MeasuredMean out;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i] >= std::uint32_t{kMeasurable}) out.add(relative_variance(mean[i], variance_of_mean[i]));
  return out.value();
}

} // namespace candela
